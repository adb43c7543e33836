// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  TEST(ContactArea, CountsPointsAndEdgesAcrossTheBoundary)
  {
    // A contact of 3 × 2 points across the periodic seam along both axes.
    const PeriodicGrid grid = {9, 8, 1., 3.};
    const SlabField    p    = sampled(grid, [&](const double x, const double y) {
      const int  ix   = static_cast<int>(std::lround(x / grid.dx()));
      const int  iy   = static_cast<int>(std::lround(y / grid.dy()));
      const bool in_x = ix == 8 || ix <= 1, in_y = iy == 7 || iy == 0;
      return in_x && in_y ? 0.5 : 0.;
    });
    const ContactState state(p, p);
    EXPECT_DOUBLE_EQ(state.contact_area, 6. / 72);
    // In spacings √(dx dy); (π − 1 + ln 2)/24 = 0.1181 of the sides is subtracted.
    const double aspect = std::sqrt(grid.dy() / grid.dx());
    const double sides  = 4 * aspect + 6 / aspect;
    EXPECT_NEAR(state.contact_area_corrected, (6 - 0.1181 * sides) / 72, 1e-5);
    // Where the pressure is at its limit up to the contact line nothing is corrected.
    EXPECT_DOUBLE_EQ(ContactState(p, p, .5).contact_area_corrected, 6. / 72);
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
    // The lattice perimeter of a large disc is 4/π times its perimeter, that is 8 r.
    const double       radius = 100.25;
    const SlabField    p      = sampled({256, 256, 256., 256.}, [=](double x, double y) {
      return std::hypot(x - 128, y - 128) <= radius ? 1. : 0.;
    });
    const ContactState state(p, p);
    // About πr² points lie in the disc (Gauss's circle problem).
    EXPECT_NEAR(state.contact_area * 65536 / (M_PI * radius * radius), 1., 1e-3);
    EXPECT_NEAR((state.contact_area - state.contact_area_corrected) * 65536,
                .118 * 8 * radius,
                1.);
  }

  TEST(ContactArea, WindowsCountWithTheirSpacing)
  {
    ZoomWindow window;
    window.x  = 8;
    window.y  = 4;
    window.nx = window.ny      = 12;
    const SlabLayoutPtr coarse = make_layout({32, 32, 32., 32.}, MPI_COMM_WORLD);
    const SlabLayoutPtr layout = with_windows(*coarse, {window});
    const auto          sides  = [&](const double x0, const double x1, const double y1) {
      const SlabField    p = sample(layout, [=](const double x, const double y) {
        return x > x0 && x < x1 && y > 5.5 && y < y1 ? 1. : 0.;
      });
      const ContactState state(p, p);
      EXPECT_NEAR(state.contact_area * 1024, (x1 - x0) * (y1 - 5.5), 1e-9);
      return (state.contact_area - state.contact_area_corrected) * 1024 * 24 /
             (M_PI - 1 + std::log(2.));
    };
    EXPECT_NEAR(sides(8.5, 18.5, 13.5), 36. / 3, 1e-9);        // all within the window
    EXPECT_NEAR(sides(10.5, 30.5, 21.5), 19. / 3 + 53., 1e-9); // 19 of 72 within it
  }
} // namespace
