// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  TEST(ContactArea, CountsPointsAndEdgesAcrossTheBoundary)
  {
    // Three by two points that wrap around both edges of a rectangular grid.
    const PeriodicGrid grid = {9, 8, 1., 3.};
    const SlabField    p    = sampled(grid, [&](const double x, const double y) {
      const int  ix   = static_cast<int>(std::lround(x / grid.dx()));
      const int  iy   = static_cast<int>(std::lround(y / grid.dy()));
      const bool in_x = ix == 8 || ix <= 1, in_y = iy == 7 || iy == 0;
      return in_x && in_y ? 0.5 : 0.;
    });
    const ContactState state(p, p);
    EXPECT_DOUBLE_EQ(state.contact_area, 6. / 72);
    // (π − 1 + ln 2)/24 an edge, in points.
    EXPECT_NEAR(state.contact_area_corrected, (6 - 0.1181 * 10) / 72, 1e-5);
  }

  TEST(ContactArea, OfNothingAndOfAll)
  {
    const SlabLayoutPtr layout = make_layout({5, 7, 1., 1.}, MPI_COMM_WORLD);
    const SlabField     nothing(layout), all(layout, 1.);
    EXPECT_EQ(ContactState(nothing, all).contact_area, 0.);
    EXPECT_EQ(ContactState(all, nothing).contact_area, 1.);
    EXPECT_EQ(ContactState(all, nothing).contact_area_corrected, 1.);
  }

  TEST(ContactArea, LatticePerimeterOfADisc)
  {
    // The lattice perimeter of a large disc is 4/π times its own.
    const double       radius = 100.25;
    const SlabField    p      = sampled({256, 256, 256., 256.}, [=](double x, double y) {
      return std::hypot(x - 128, y - 128) <= radius ? 1. : 0.;
    });
    const ContactState state(p, p);
    // Points in a disc: Gauss's circle problem.
    EXPECT_NEAR(state.contact_area * 65536 / (M_PI * radius * radius), 1., 1e-3);
    EXPECT_NEAR((state.contact_area - state.contact_area_corrected) * 65536,
                .118 * 8 * radius,
                1.);
  }
} // namespace
