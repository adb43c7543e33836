// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/fluid_on_wall.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "window_tools.h"

namespace strait
{
  namespace
  {
    constexpr double inlet = 3., outlet = 1.;

    /** Open except for a disc and a bar across the box. */
    double
    gap_at(const double x, const double y)
    {
      const double disc = std::hypot(x - .6, y - .5) - .2;
      return std::max(std::min(disc, std::abs(x - .15) - .05), 0.);
    }

    SlabLayoutPtr
    layout_for(const int nx, const int ny)
    {
      return make_layout(PeriodicGrid{nx, ny, 1., 1.}, MPI_COMM_WORLD);
    }

    template <class Function>
    SlabField
    field_of(const SlabLayoutPtr &layout, const Function &f)
    {
      SlabField           field(layout);
      const PeriodicGrid &grid = layout->grid();
      for (int row = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < grid.nx; ++ix)
          field(ix, row) = f(ix * grid.dx(), (layout->first_row() + row) * grid.dy());
      return field;
    }

    TEST(HarmonicExtension, KeepsLinearAndUniformPressures)
    {
      for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
        {
          const bool          along_x = direction == FlowDirection::x;
          const SlabLayoutPtr layout  = layout_for(64, 48);
          const auto          turned  = [along_x](const double x, const double y) {
            return along_x ? gap_at(x, y) : gap_at(y, x);
          };
          const SlabField gap   = field_of(layout, turned);
          const auto      exact = [along_x](const double x, const double y) {
            return inlet + (outlet - inlet) * (along_x ? x : y);
          };
          SlabField pressure = field_of(layout, [&](const double x, const double y) {
            return turned(x, y) > 0 ? exact(x, y) : 0.;
          });
          EXPECT_GT(extend_under_contact(pressure, gap, direction, inlet, outlet), 0);
          double          largest = 0;
          const SlabField linear  = field_of(layout, exact);
          for (int row = 0; row < layout->n_rows(); ++row)
            for (int ix = 0; ix < 64; ++ix)
              if (along_x ? ix > 0 : layout->first_row() + row > 0)
                largest =
                  std::max(largest, std::abs(pressure(ix, row) - linear(ix, row)));
          EXPECT_LT(largest, 1e-5);

          SlabField uniform(layout, 2.);
          EXPECT_EQ(extend_under_contact(uniform, gap, direction, 2., 2.), 0);
          EXPECT_DOUBLE_EQ(min_value(uniform), 2.);
          EXPECT_DOUBLE_EQ(max_value(uniform), 2.);
        }
    }

    TEST(HarmonicExtension, ObeysTheMaximumPrinciple)
    {
      const SlabLayoutPtr layout   = layout_for(64, 64);
      const SlabField     gap      = field_of(layout, gap_at);
      SlabField           pressure = field_of(layout, [](const double x, const double y) {
        return gap_at(x, y) <= 0 ? 77. : x < .15 ? inlet : y < .5 ? outlet : 2.;
      });
      extend_under_contact(pressure, gap, FlowDirection::x, inlet, outlet);
      EXPECT_LE(max_value(pressure), inlet + 1e-6);
      EXPECT_GE(min_value(pressure), outlet - 1e-6);
    }

    /** Across the seam, across the edge of the disc, and, nested in that, in the disc. */
    const std::vector<ZoomWindow> windows = {window_tests::window_at(-6, 10, 12, 14),
                                             window_tests::window_at(24, 26, 14, 16),
                                             {1, 2, 8, 9, 20, 18}};

    TEST(HarmonicExtension, KeepsLinearPressuresInWindowsParallel)
    {
      for (const bool along_x : {true, false})
        {
          const SlabLayoutPtr layout = window_tests::layout_with(
            64, along_x ? windows : window_tests::transposed(windows));
          const auto gap = [along_x](const double x, const double y) {
            return along_x ? gap_at(x - std::floor(x), y) : gap_at(y - std::floor(y), x);
          };
          // Beyond the seam the next period begins.
          const auto exact = [along_x](const double x, const double y) {
            const double along = along_x ? x : y;
            return inlet + (outlet - inlet) * (along - std::floor(along));
          };
          SlabField pressure = sample(layout, [&](const double x, const double y) {
            return gap(x, y) > 0 ? exact(x, y) : 0.;
          });
          extend_under_contact(pressure,
                               sample(layout, gap),
                               along_x ? FlowDirection::x : FlowDirection::y,
                               inlet,
                               outlet);
          std::size_t k = 0;
          layout->for_each_point([&](const GridPoint &point) {
            const auto [x, y]    = layout->position(point.window, point.ix, point.iy);
            const double along   = along_x ? x : y;
            const bool   on_seam = std::abs(along - std::round(along)) < 1e-9;
            EXPECT_NEAR(pressure[k++], on_seam ? 2. : exact(x, y), 1e-5)
              << point.ix << ' ' << point.iy << ' ' << point.window;
          });
        }
    }

    TEST(HarmonicExtension, ObeysTheMaximumPrincipleInWindowsParallel)
    {
      const SlabLayoutPtr layout   = window_tests::layout_with(64, windows);
      const SlabField     gap      = sample(layout, gap_at);
      SlabField           pressure = sample(layout, [](const double x, const double y) {
        return gap_at(x, y) <= 0 ? 77. : y < .5 ? outlet : 2.;
      });
      extend_under_contact(pressure, gap, FlowDirection::x, 2., outlet);
      EXPECT_LE(max_value(pressure), 2. + 1e-6);
      EXPECT_GE(min_value(pressure), outlet - 1e-6);
    }

    TEST(HarmonicExtension, IsThatOfTheFineGridInAWindowParallel)
    {
      // The pressure jumps at a point of the disc's edge, which only its window resolves.
      const auto fluid = [](const double x, const double y) {
        return gap_at(x, y) <= 0 ? 0. : y < .5 ? outlet : 2.;
      };
      const SlabLayoutPtr layout = window_tests::layout_with(64, windows);
      const SlabLayoutPtr fine   = layout_for(192, 192);
      SlabField pressure = sample(layout, fluid), expected = sample(fine, fluid);
      extend_under_contact(pressure, sample(layout, gap_at), FlowDirection::x, 2., 1.);
      extend_under_contact(expected, sample(fine, gap_at), FlowDirection::x, 2., 1.);
      const ZoomWindow &window  = windows[1];
      double            largest = 0.;
      for (int iy = 0; iy < window.n_rows(); ++iy)
        {
          const auto line = fetch_rows(expected, {3 * window.y - 1 + iy});
          for (int ix = 0; ix < window.n_columns(); ++ix)
            largest = std::max(largest,
                               std::abs(pressure[layout->index_of({ix, iy, 1})] -
                                        line[3 * window.x - 1 + ix]));
        }
      EXPECT_LT(largest, .05); // reached at the rim; 0.3 without a window
    }

    TEST(HarmonicExtension, KeepsTheFluidOfAClosedPointParallel)
    {
      // One closed point beside the open gap, and one far from it.
      const SlabLayoutPtr layout   = layout_for(32, 32);
      const auto          is_known = [](const double x, const double y) {
        return (x == .5 && y == .5) || (x == .5 && y == 19. / 32.);
      };
      const auto wall = [](const double, const double y) {
        return std::abs(y - .5) < .1 ? 0. : 1.;
      };
      const auto gap      = field_of(layout, [&](const double x, const double y) {
        return is_known(x, y) ? -std::numeric_limits<double>::min() : wall(x, y);
      });
      SlabField  pressure = field_of(layout, [&](const double x, const double y) {
        return is_known(x, y) ? 5. : 1.;
      });
      extend_under_contact(pressure, gap, FlowDirection::x, 1., 1.);
      EXPECT_EQ(max_value(pressure), 5.);
      std::vector<double> known;
      for (const int iy : {16, 19})
        known.push_back(fetch_rows(pressure, {iy})[16]);
      EXPECT_EQ(known, std::vector<double>(2, 5.));
    }

    TEST(HarmonicExtension, DoesNotJumpWhenAPointOpens)
    {
      // The same point, once closed and once just open, where the fluid's pressure
      // differs from the extension around it.
      const SlabLayoutPtr layout = layout_for(32, 32);
      double              means[2];
      for (const int open : {0, 1})
        {
          SlabField gap = field_of(layout, [open](const double x, const double y) {
            const bool opening = x == .5 && y == .25;
            return opening ? 1e-6 * open : gap_at(x, y);
          });
          SlabField pressure =
            field_of(layout, [](const double x, const double y) { return x + y; });
          extend_under_contact(pressure, gap, FlowDirection::x, 1., 0.);
          means[open] = mean(pressure);
        }
      EXPECT_NEAR(means[0], means[1], 1e-6);
    }
  } // namespace
} // namespace strait
