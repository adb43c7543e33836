// SPDX-License-Identifier: GPL-2.0-or-later
// The cheap compliance by which the gap problem is preconditioned.
#include <strait/contact/two_scale_compliance.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  constexpr double modulus = 3., uniform = .7;

  SlabField
  displaced(SlabField field)
  {
    TwoScaleCompliance compliance(field.layout_pointer(), modulus, uniform);
    compliance.apply(
      field.data(), [](int) {}, [](int) {});
    return field;
  }

  class TwoScaleComplianceOn : public testing::TestWithParam<PeriodicGrid>
  {
  };

  TEST_P(TwoScaleComplianceOn, IsSymmetric)
  {
    const SlabField a = any_field(GetParam(), 1.), b = any_field(GetParam(), 1.7);
    const double    a_Mb = dot(a, displaced(b)), Ma_b = dot(displaced(a), b);
    EXPECT_NEAR(a_Mb, Ma_b, 1e-11 * std::sqrt(dot(a, a) * dot(b, b)));
  }

  TEST_P(TwoScaleComplianceOn, IsCloseToThatOfTheHalfSpace)
  {
    const PeriodicGrid grid = GetParam();
    for (const auto &[x, y] : std::vector<std::pair<double, double>>{{0.06, 0.},
                                                                     {0., 0.06},
                                                                     {0.12, 0.06},
                                                                     {0.2, 0.},
                                                                     {0.25, 0.25},
                                                                     {0.4, 0.3},
                                                                     {0.5, 0.2},
                                                                     {1., 0.},
                                                                     {0., 1.},
                                                                     {1., 1.}})
      {
        const int       kx = static_cast<int>(x * grid.nx / 2);
        const int       ky = static_cast<int>(y * grid.ny / 2);
        const double    qx = 2 * pi * kx / grid.lx, qy = 2 * pi * ky / grid.ly;
        const SlabField wave =
          sampled(grid, [qx = qx, qy = qy](const double px, const double py) {
            return std::cos(qx * px + qy * py);
          });
        const double ratio =
          dot(wave, displaced(wave)) / dot(wave, wave) * std::hypot(qx, qy) * modulus / 2;
        EXPECT_GT(ratio, .7) << kx << ' ' << ky;
        EXPECT_LT(ratio, 1.15) << kx << ' ' << ky;
      }
    const SlabField ones(make_layout(grid, MPI_COMM_WORLD), 1.);
    const SlabField result = displaced(ones);
    EXPECT_NEAR(min_value(result), uniform, 1e-12);
    EXPECT_NEAR(max_value(result), uniform, 1e-12);
  }

  INSTANTIATE_TEST_SUITE_P(
    Grids,
    TwoScaleComplianceOn,
    testing::Values(PeriodicGrid{128, 128, 1., 1.}, // on 3 ranks blocks are shared
                    PeriodicGrid{64, 96, 2., 2.5}));

  TEST(TwoScaleCompliance, IsTheSameOnAnyNumberOfRanks)
  {
    const PeriodicGrid grid   = {128, 132, 1., 1.};
    const SlabField    result = displaced(any_field(grid, 1.));
    EXPECT_NEAR(dot(result, any_field(grid, 0.6)), 269.41066781912889, 1e-9);
    EXPECT_NEAR(dot(result, result), 183.95984182057583, 1e-9);
  }

  TEST(TwoScaleCompliance, SuitsGridsThatCanBeCoarsened)
  {
    EXPECT_TRUE(TwoScaleCompliance::suits({32, 64, 1., 2.}));
    EXPECT_FALSE(TwoScaleCompliance::suits({32, 64, 1., 1.})); // spaced unequally
    EXPECT_FALSE(TwoScaleCompliance::suits({66, 64, 1., 1.}));
    EXPECT_FALSE(TwoScaleCompliance::suits({16, 16, 1., 1.}));
  }
} // namespace
