// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/grid_transfer.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  double
  periodic_wave(const double x, const double y)
  {
    return 1 + std::sin(2 * pi * x) * std::cos(4 * pi * (y + 0.1)) +
           0.2 * std::cos(2 * pi * x);
  }

  TEST(GridTransfer, NeedsEvenGridsOfAtLeast64)
  {
    EXPECT_TRUE(can_be_coarsened({64, 64, 1., 1.}));
    EXPECT_TRUE(can_be_coarsened({70, 90, 1., 1.}));
    EXPECT_FALSE(can_be_coarsened({62, 64, 1., 1.}));
    EXPECT_FALSE(can_be_coarsened({128, 65, 1., 1.}));
  }

  TEST(GridTransfer, RestrictionSamplesTheSameFunction)
  {
    const SlabField fine   = sampled({64, 70, 1., 1.}, periodic_wave);
    const SlabField coarse = sampled({32, 35, 1., 1.}, periodic_wave);
    EXPECT_LT(largest_difference(restrict_by_injection(fine), coarse), 1e-14);
  }

  TEST(GridTransfer, ProlongationIsOfSecondOrderAndKeepsTheCoarsePoints)
  {
    double last_error = 0;
    for (const int n : {66, 132, 264})
      {
        const SlabField coarse = sampled({n / 2, n / 2, 1., 1.}, periodic_wave);
        const SlabField exact  = sampled({n, n, 1., 1.}, periodic_wave);
        const SlabField fine   = prolong_bilinearly(coarse, exact.layout_pointer());
        EXPECT_EQ(largest_difference(restrict_by_injection(fine), coarse), 0.);
        const double error = largest_difference(fine, exact);
        if (last_error > 0)
          {
            EXPECT_NEAR(last_error / error, 4., 0.2);
          }
        last_error = error;
      }
  }

  TEST(GridTransfer, ZoomsInLinearly)
  {
    // Linear in each of the windows, of which two lie in the grid and one in another.
    const auto linear = [](const double x, const double y) {
      return std::abs(x - .5) + 2 * y;
    };
    const std::vector<ZoomWindow> first = {{-1, 1, 36, 6, 16, 14}};
    std::vector<ZoomWindow>       both  = {{-1, 1, 8, 30, 12, 12}, first[0]};
    both.push_back({1, 2, 9, 8, 12, 15});
    const SlabField grid = sampled({64, 64, 1., 1.}, linear);
    SlabField       once = zoom_in_linearly(grid, first);
    EXPECT_LT(largest_difference(once, sample(once.layout_pointer(), linear)), 1e-14);
    // Values that were known in a window are kept.
    once[once.layout().start_of_window(0)] = 77.;
    const SlabField twice                  = zoom_in_linearly(once, both);
    SlabField       expected               = sample(twice.layout_pointer(), linear);
    expected[expected.layout().start_of_window(1)] = 77.;
    EXPECT_LT(largest_difference(twice, expected), 1e-14);
  }
} // namespace
