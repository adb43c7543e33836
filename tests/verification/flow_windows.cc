// SPDX-License-Identifier: GPL-2.0-or-later
// Leak rates of gaps that are sampled more finely in nested windows.
#include <strait/flow/leakage.h>
#include <strait/flow/solution_on_grid.h>

#include <deal.II/base/timer.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "flow_fixture.h"

namespace strait
{
  namespace
  {
    /** Solves for the flow through a gap and prints what it took. */
    struct SolvedOnWindows
    {
      SolvedOnWindows(const SlabField &gap, const FluidParameters &fluid)
        : given(gap, fluid)
        , solver(fluid, given.field)
      {
        const dealii::Timer timer;
        const auto n_start = solver.mesh().triangulation().n_global_active_cells();
        flow               = solver.run(given.channel);
        if (gap.layout().rank() == 0)
          std::printf(
            "%4d² points, %zu windows: %.5g … %.5g, %u meshes, %llu … %llu cells, "
            "%llu unknowns, %.2f s\n",
            gap.grid().nx,
            gap.layout().windows().size(),
            flow.lower,
            flow.upper,
            flow.refinements + 1,
            static_cast<unsigned long long>(n_start),
            flow.cells,
            flow.unknowns,
            timer.wall_time());
      }

      GivenGap       given;
      ReynoldsSolver solver;
      Leakage        flow;
    };

    /** The saddle between the contacts of a square lattice, shifted by @p shift_x along
     *  the flow and by @p shift_y across it. The gap doubles at a distance of √gap/π. */
    GapFunction
    saddle(const double gap, const double shift_y = 0., const double shift_x = 0.)
    {
      return [=](const double x, const double y) {
        return gap + .5 * (std::cos(2 * pi * (y - .5 - shift_y)) -
                           std::cos(2 * pi * (x - .5 - shift_x)));
      };
    }

    /** @p n_levels nested windows around the point (@p middle_x, @p middle_y) of an n × n
     *  grid, each on @p n_covered points of its parent in both directions. */
    SlabLayoutPtr
    nested(const int n,
           const int n_levels,
           const int n_covered,
           int       middle_x,
           int       middle_y)
    {
      std::vector<ZoomWindow> windows;
      for (int l = 1; l <= n_levels; ++l)
        {
          const int x = middle_x - n_covered / 2, y = middle_y - n_covered / 2;
          windows.push_back({l - 2,
                             l,
                             l == 1 ? (x + n) % n : x,
                             l == 1 ? (y + n) % n : y,
                             n_covered,
                             n_covered});
          middle_x = 3 * (middle_x - x) + 1;
          middle_y = 3 * (middle_y - y) + 1;
        }
      return with_windows(*make_layout({n, n, 1., 1.}, MPI_COMM_WORLD), windows);
    }

    SlabLayoutPtr
    uniform(const int n)
    {
      return make_layout({n, n, 1., 1.}, MPI_COMM_WORLD);
    }

    FluidParameters
    fluid_along(const FlowDirection direction, const double target_accuracy = 1e-2)
    {
      FluidParameters fluid = plain_fluid(target_accuracy);
      fluid.direction       = direction;
      return fluid;
    }

    // Half of the throat's length is one spacing on 48² points and nine on 432². Where
    // the windows end, the gap interpolated between 48² points is off by 4e-4, a
    // hundredth of it, but only 1e-3 of the pressure drops there.
    TEST(FlowWindows, NarrowSaddleIsThatOfAFinerGridParallel)
    {
      const double gap = 4e-3;
      for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
        {
          const FluidParameters fluid = fluid_along(direction);
          GapFunction           along = saddle(gap);
          if (direction == FlowDirection::y)
            along = [gap](const double x, const double y) { return saddle(gap)(y, x); };
          const SolvedOnWindows fine(sample(uniform(432), along), fluid);
          const SolvedOnWindows windows(sample(nested(48, 2, 18, 24, 24), along), fluid);
          const SolvedOnWindows coarse(sample(uniform(48), along), fluid);
          constexpr double      interpolation = 1e-3;
          EXPECT_EQ(windows.flow.status, "ok");
          EXPECT_LT(windows.flow.lower, windows.flow.upper);
          EXPECT_LT(windows.flow.lower, fine.flow.upper * (1 + interpolation));
          EXPECT_GT(windows.flow.upper, fine.flow.lower * (1 - interpolation));
          // Without windows, the throat is another one.
          EXPECT_GT(std::abs(coarse.flow.rate / fine.flow.rate - 1.), .02);
          EXPECT_LT(windows.flow.unknowns, 2 * fine.flow.unknowns);
          // The constriction lies in the finest window, with nearly all of the drop.
          const auto report = report_constrictions(windows.given.channel, windows.solver);
          const FlowPath &path = windows.given.channel.paths.front();
          EXPECT_EQ(path.bottleneck.window, 1);
          EXPECT_NEAR(path.bottleneck_gap, gap, 1e-12);
          EXPECT_GT(report.fraction_at_worst, .99);
        }
    }

    // An isolated saddle leaks in proportion to gap³, however small the gap.
    TEST(FlowWindows, SixLevelsFindTheSaddleThatTwoFind)
    {
      const FluidParameters fluid = plain_fluid(1e-2);
      const SolvedOnWindows two(sample(nested(256, 2, 60, 128, 128), saddle(1e-3)),
                                fluid);
      const SolvedOnWindows six(sample(nested(256, 6, 60, 128, 128), saddle(1e-7)),
                                fluid);
      EXPECT_EQ(six.flow.status, "ok");
      EXPECT_LT(six.flow.cells, 10000U);
      EXPECT_LT(six.flow.relative_width(), 1e-2);
      EXPECT_NEAR(six.flow.rate / two.flow.rate / 1e-12, 1., 1e-2);
    }

    // One half of a throat on the seam lies at the inlet, the other one at the outlet.
    // Between them, where the gap is 10⁷ times as wide, the pressure must be the mean of
    // both reservoirs.
    TEST(FlowWindows, HalvesOfAThroatAreBalancedAcrossAWideRegion)
    {
      const double          gap   = 1e-7;
      const FluidParameters fluid = plain_fluid(3e-3);
      const SolvedOnWindows middle(sample(nested(256, 6, 60, 128, 128), saddle(gap)),
                                   fluid);
      const SolvedOnWindows seam(sample(nested(256, 6, 60, 0, 128), saddle(gap, 0., .5)),
                                 fluid);
      EXPECT_EQ(seam.flow.status, "ok");
      EXPECT_NEAR(seam.flow.rate / middle.flow.rate, 1., 3e-3);
      const auto report = report_constrictions(seam.given.channel, seam.solver);
      EXPECT_NEAR(report.fraction_at_worst, .5, 1e-3);
    }

    // Across the flow, a window may cross the seam, and a shift changes nothing, although
    // 1/K spans a factor of 1e15 and only one value of the stream function is fixed. The
    // meshes are uniform: of symmetric cells, rounding decides which one is refined.
    TEST(FlowWindows, MayCrossTheSeamParallel)
    {
      FluidParameters fluid    = plain_fluid(.2);
      fluid.uniform_refinement = true;
      const SolvedOnWindows middle(sample(nested(64, 2, 20, 32, 32), saddle(4e-3)),
                                   fluid);
      const double          of_middle =
        report_constrictions(middle.given.channel, middle.solver).fraction_at_worst;
      for (const int row : {0, 8})
        {
          const SolvedOnWindows moved(sample(nested(64, 2, 20, 32, row),
                                             saddle(4e-3, row / 64. - .5)),
                                      fluid);
          EXPECT_EQ(moved.given.field.layout().windows().front().y, (row + 54) % 64);
          EXPECT_EQ(moved.flow.refinements, middle.flow.refinements);
          EXPECT_NEAR(moved.flow.upper / middle.flow.upper, 1., 1e-7);
          EXPECT_NEAR(moved.flow.lower / middle.flow.lower, 1., 1e-7);
          EXPECT_NEAR(
            report_constrictions(moved.given.channel, moved.solver).fraction_at_worst,
            of_middle,
            1e-6);
        }
    }

    // The pressure at the points of a window is that at the same points of the grid.
    TEST(FlowWindows, PicturesOfAWindowFitThoseOfTheGridParallel)
    {
      const SlabLayoutPtr   layout = nested(64, 1, 20, 32, 0);
      const SolvedOnWindows solved(sample(layout, saddle(1e-2, -.5)), plain_fluid(1e-2));
      const PointRows       rows = rows_of_window(*layout, 0);
      const auto on_grid = flow_at_points(solved.solver, rows_of_grid(layout->grid(), 1));
      const auto in_window = flow_at_points(solved.solver, rows);
      if (layout->rank() != 0)
        return;
      const ZoomWindow &window = layout->windows().front();
      for (int b = 0; b < window.ny; ++b)
        for (int a = 0; a < window.nx; ++a)
          {
            const std::size_t k =
              static_cast<std::size_t>((window.y + b) % 64) * 64 + window.x + a;
            const std::size_t w =
              static_cast<std::size_t>(3 * b + 1) * rows.nx + 3 * a + 1;
            EXPECT_NEAR(in_window.pressure[w], on_grid.pressure[k], 1e-5)
              << a << ' ' << b;
          }
      // The middle of the throat is at half the pressure.
      EXPECT_NEAR(in_window.pressure[static_cast<std::size_t>(31) * rows.nx + 31],
                  .5,
                  .02);
    }

    TEST(FlowWindows, PressureFallsEvenlyInAUniformGapParallel)
    {
      const SlabLayoutPtr layout = with_windows(
        *make_layout({64, 64, 1., 1.}, MPI_COMM_WORLD),
        {{-1, 1, -6, 10, 12, 14}, {-1, 1, 24, 26, 14, 16}, {1, 2, 8, 9, 20, 18}});
      const SolvedOnWindows solved(SlabField(layout, .1), plain_fluid());
      const SlabField       potential = potential_on_grid(solved.solver, layout);
      const double         *next      = potential.data();
      layout->for_each_point([&](const GridPoint &point) {
        const double x = layout->position(point.window, point.ix, point.iy)[0];
        // On the seam, the potential is that of the inlet.
        EXPECT_NEAR(*next++, 1. - (x - std::floor(x + 1e-12)), 1e-8)
          << point.ix << ' ' << point.iy << ' ' << point.window;
      });
    }

    // Along the flow, the seam is inlet and outlet, and a window may lie across it.
    TEST(FlowWindows, MayLieAcrossInletAndOutletParallel)
    {
      const auto gap = [](const double x, const double y) {
        return .02 + (1 - std::cos(2 * pi * x)) - .5 * (1 - std::cos(2 * pi * y));
      };
      const FluidParameters fluid = plain_fluid(1e-2);
      const SlabLayoutPtr layout  = with_windows(*uniform(48), {{-1, 1, 38, 38, 20, 20}});
      const SolvedOnWindows fine(sample(uniform(144), gap), fluid);
      const SolvedOnWindows windows(sample(layout, gap), fluid);
      EXPECT_EQ(windows.flow.status, "ok");
      EXPECT_LT(windows.flow.lower, fine.flow.upper * (1 + 1e-3));
      EXPECT_GT(windows.flow.upper, fine.flow.lower * (1 - 1e-3));
      // Each half of the throat takes about half of the pressure drop.
      const auto a = report_constrictions(fine.given.channel, fine.solver);
      const auto b = report_constrictions(windows.given.channel, windows.solver);
      EXPECT_GT(a.fraction_at_worst, .4);
      EXPECT_NEAR(a.fraction_at_worst, b.fraction_at_worst, .02);
      // The outlet lies to the left of the seam, the inlet to the right.
      const PointRows rows = rows_of_window(*layout, 0);
      const auto      flow = flow_at_points(windows.solver, rows);
      const int       seam = 3 * 10 + 1, middle = seam;
      if (layout->rank() != 0)
        return;
      const auto pressure = [&](const int ix) {
        return flow.pressure[static_cast<std::size_t>(middle) * rows.nx + ix];
      };
      EXPECT_NEAR(pressure(seam), 1., 1e-6);
      EXPECT_GT(pressure(seam + 3), .5);
      EXPECT_LT(pressure(seam - 3), .5);
    }

    // The pressure depends on x alone, so that the exact resistance is an integral. All
    // of it but a few per cent lies in the windows.
    TEST(FlowWindows, ParabolicConstrictionIsEnclosedParallel)
    {
      const double t = 8., length = 1., width = 4.;
      const double q = 1 + t * t;
      const double resistance =
        length / width * (35. / 32) * 2 *
        (t / (4 * q * q) + 3 * t / (8 * q) + 3. / 8 * std::atan(t));
      const auto gap = [=](double x, double y) {
        x -= t * length;
        y -= t * length;
        return (1 + x * x / (length * length)) * (1 - y * y / (width * width));
      };
      const SlabLayoutPtr grid = make_layout({128, 128, 16., 16.}, MPI_COMM_WORLD);
      const SlabLayoutPtr layout =
        with_windows(*grid, {{-1, 1, 40, 24, 48, 80}, {0, 2, 40, 20, 64, 200}});
      const SolvedOnWindows solved(sample(layout, gap), plain_fluid(1e-3));
      EXPECT_EQ(solved.flow.status, "ok");
      EXPECT_LE(solved.flow.lower, 1. / resistance);
      EXPECT_GE(solved.flow.upper, 1. / resistance);
      EXPECT_NEAR(solved.flow.rate * resistance, 1., 1e-3);
    }

    // Stripes along and across the flow, partly in windows. The closed forms are the mean
    // of g³ and the inverse mean of g⁻³, up to the error of interpolation.
    TEST(FlowWindows, LaminatesAcrossWindowsParallel)
    {
      const double epsilon = .5;
      // One window with another one in it, and one across both seams.
      const auto layout = with_windows(*uniform(32),
                                       {{-1, 1, 3, 9, 12, 10},
                                        {0, 2, 5, 6, 20, 12},
                                        {-1, 1, 26, 28, 9, 8}});
      for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
        {
          const double exact =
            direction == FlowDirection::x
              ? std::pow(1 - epsilon * epsilon, 2.5) / (1 + epsilon * epsilon / 2)
              : 1 + 1.5 * epsilon * epsilon;
          const SlabField       gap = sample(layout, [=](const double x, double) {
            return 1 + epsilon * std::cos(2 * pi * x);
          });
          const SolvedOnWindows solved(gap, fluid_along(direction, 1e-3));
          EXPECT_EQ(solved.flow.status, "ok");
          EXPECT_LT(solved.flow.relative_width(), 1e-3);
          EXPECT_NEAR(solved.flow.rate / exact, 1., 5e-3);
        }
    }

    TEST(FlowWindows, RigorousBoundsHoldParallel)
    {
      const SlabField       gap        = sample(nested(48, 2, 18, 24, 24), saddle(4e-3));
      const SolvedOnWindows asymptotic = {gap, plain_fluid(1e-3)};
      FluidParameters       fluid      = plain_fluid(.2);
      fluid.rigorous_bounds            = true;
      const SolvedOnWindows rigorous(gap, fluid);
      EXPECT_EQ(rigorous.flow.status, "ok");
      EXPECT_LE(rigorous.flow.lower, asymptotic.flow.lower);
      EXPECT_GE(rigorous.flow.upper, asymptotic.flow.upper);
    }
  } // namespace
} // namespace strait
