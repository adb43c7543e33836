// SPDX-License-Identifier: GPL-2.0-or-later
// Leak rates of gaps whose effective conductivity is known in closed form.
#include <strait/flow/solution_on_grid.h>

#include <gtest/gtest.h>

#include "flow_fixture.h"
#include "reference/plate_flow.h"

namespace strait
{
  namespace
  {
    /** Expect that the bracket, which is that of the interpolated gap, contains @p exact
     *  up to the relative @p slack; without it, interpolation must not matter. */
    void
    expect_contains(const Leakage &flow, const double exact, const double slack = 0.)
    {
      EXPECT_EQ(flow.status, "ok");
      EXPECT_LE(flow.lower, exact * (1 + slack));
      EXPECT_GE(flow.upper, exact * (1 - slack));
      EXPECT_LE(flow.lower, flow.rate * (1 + slack));
      EXPECT_GE(flow.upper, flow.rate * (1 - slack));
    }

    TEST(FlowClosedForms, ParallelPlatesAreExactInBothDirections)
    {
      const double    gap   = 0.3;
      FluidParameters fluid = plain_fluid();
      fluid.viscosity       = 0.7;
      fluid.inlet_pressure  = 5.;
      fluid.outlet_pressure = 2.;
      const SlabField plates =
        sample([=](double, double) { return gap; }, 64, 32, 2., .5);
      for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
        {
          fluid.direction      = direction;
          const double  aspect = direction == FlowDirection::x ? .5 / 2. : 2. / .5;
          const double  exact  = gap * gap * gap / (12 * .7) * 3. * aspect;
          const Leakage flow   = leak(plates, fluid);
          expect_contains(flow, exact, 1e-9);
          EXPECT_NEAR(flow.upper / exact, 1., 1e-8);
          EXPECT_NEAR(flow.lower / exact, 1., 1e-8);
        }
    }

    // For a gas in a uniform gap, p² is linear, and the volume flow at the mean pressure
    // is that of a liquid.
    TEST(FlowClosedForms, GasKeepsItsPressureLonger)
    {
      FluidParameters fluid = plain_fluid();
      fluid.is_gas          = true;
      fluid.inlet_pressure  = 3.;
      fluid.outlet_pressure = 1.;
      const GivenGap given(sample([](double, double) { return 1.; }, 32, 32), fluid);
      ReynoldsSolver solver(fluid, given.field);
      EXPECT_NEAR(solver.run(given.channel).rate, 2., 1e-8);
      EXPECT_NEAR(solver.pressure_at(0.), 1., 1e-12);
      EXPECT_NEAR(solver.pressure_at(.5), std::sqrt(5.), 1e-12);
      EXPECT_NEAR(solver.pressure_at(1.), 3., 1e-12);
    }

    TEST(FlowClosedForms, ReversedPressureReversesTheLeak)
    {
      FluidParameters fluid = plain_fluid();
      fluid.inlet_pressure  = 0.;
      fluid.outlet_pressure = 1.;
      const Leakage flow = leak(sample([](double, double) { return 1.; }, 32, 32), fluid);
      EXPECT_NEAR(flow.rate, -1., 1e-8);
      EXPECT_LE(flow.lower, 1 + 1e-9);
      EXPECT_GE(flow.upper, 1 - 1e-9);
    }

    // g = 1 + ε cos kx: resistances in series along x, parallel conductivities along y.
    TEST(FlowClosedForms, OneDimensionalGapsConvergeAtSecondOrderOrBetter)
    {
      const double epsilon = 0.5;
      for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
        {
          FluidParameters fluid = plain_fluid(3e-5);
          fluid.direction       = direction;
          const double exact =
            direction == FlowDirection::x
              ? std::pow(1 - epsilon * epsilon, 2.5) / (1 + epsilon * epsilon / 2)
              : 1 + 1.5 * epsilon * epsilon;
          std::vector<double> errors;
          // The gap varies along x only, so a strip of four points is enough.
          const auto strip = [=](const int n) {
            return sample([=](const double x,
                              double) { return 1 + epsilon * std::cos(2 * pi * x); },
                          n,
                          4,
                          1.,
                          4. / n);
          };
          const auto aspect = [=](const double ly) {
            return direction == FlowDirection::x ? ly : 1. / ly;
          };
          for (const int n : {8, 16, 32})
            {
              const Leakage flow = leak(strip(n), fluid);
              EXPECT_LT(flow.relative_width(), 3e-5);
              errors.push_back(std::abs(flow.rate / (exact * aspect(4. / n)) - 1));
            }
          fluid.target_accuracy = 1e-3;
          // One of the bounds is attained, so that the error of interpolation shows: 3e-9
          // on 512 points.
          expect_contains(leak(strip(512), fluid), exact * aspect(4. / 512), 1e-8);
          EXPECT_LT(errors[2], 5e-3);
          EXPECT_GT(std::log2(errors[0] / errors[2]) / 2, 1.7);
        }
    }

    TEST(FlowClosedForms, SeparableGapIsTheProduct)
    {
      const double along  = std::pow(1 - .09, 2.5) / (1 + .09 / 2);
      const double across = 1 + 1.5 * .16;
      const auto   gap    = [](const double x, const double y) {
        return (1 + .3 * std::cos(2 * pi * x)) * (1 + .4 * std::cos(2 * pi * y));
      };
      const Leakage flow = leak(sample(gap, 128, 128), plain_fluid(1e-3));
      expect_contains(flow, along * across);
      EXPECT_NEAR(flow.rate / (along * across), 1., 1e-3);
    }

    // The flow is singular at the corners, which takes local refinement.
    TEST(FlowClosedForms, CheckerboardTendsToTheGeometricMean)
    {
      const double        low = 1., high = 2.; // conductivities 1 and 8
      const auto          exact = std::sqrt(1. * 8.);
      std::vector<double> errors;
      for (const int n : {64, 256})
        {
          // The reservoirs must lie on lines of mirror symmetry, so the board is shifted
          // by a quarter period; half a spacing more gives both phases as many points.
          const SlabField board = sample(
            [=](const double x, const double y) {
              const auto inside = [=](const double s) {
                return std::abs(s + .5 / n - .5) < .25;
              };
              return inside(x) == inside(y) ? low : high;
            },
            n,
            n);
          FluidParameters fluid = plain_fluid(5e-3);
          fluid.interpolation   = GapInterpolation::bilinear;
          const Leakage flow    = leak(board, fluid);
          EXPECT_LT(flow.relative_width(), 5e-3);
          errors.push_back(std::abs(flow.rate / exact - 1));
        }
      EXPECT_LT(errors[1], .02);
      EXPECT_LT(errors[1], .5 * errors[0]);
    }

    // Interpolation smears a jump between points. But the leak rate grows with the gap,
    // so the lower bound for a gap below the exact one and the upper bound for a gap
    // above it enclose the exact value. Interpolants stay between the values at the
    // corners of their cells: extremes over the neighbours of a point are enough.
    TEST(FlowClosedForms, CheckerboardIsEnclosed)
    {
      const double        exact = std::sqrt(1. * 8.);
      std::vector<double> widths;
      for (const int n : {64, 256})
        {
          const auto extreme = [=](const double rare, const double spread) {
            return sample(
              [=](const double x, const double y) {
                const auto inside = [](const double s) { return std::abs(s - .5) < .25; };
                for (const int i : {-1, 0, 1})
                  for (const int j : {-1, 0, 1})
                    if ((inside(x + 1. * i / n) == inside(y + 1. * j / n)) ==
                        (spread < rare))
                      return spread;
                return rare;
              },
              n,
              n);
          };
          const FluidParameters fluid = plain_fluid(5e-3);
          const double          lower = leak(extreme(2., 1.), fluid).lower;
          const double          upper = leak(extreme(1., 2.), fluid).upper;
          EXPECT_LE(lower, exact);
          EXPECT_GE(upper, exact);
          widths.push_back(1. - lower / upper);
        }
      EXPECT_LT(widths[1], .16);
      EXPECT_LT(widths[1], .6 * widths[0]);
    }

    TEST(FlowClosedForms, ImpermeableDiscsAreEnclosed)
    {
      const int    n     = 512;
      const double exact = 0.537580, radius = std::sqrt(.3 / pi);
      const auto   discs = [=](const double r) {
        return sample(
          [=](const double x, const double y) {
            return std::hypot(x - .5, y - .5) > r ? 1. : -1.;
          },
          n,
          n);
      };
      const double          diagonal = std::sqrt(2.) / n;
      const FluidParameters fluid    = plain_fluid(5e-3);
      const double          lower    = leak(discs(radius + diagonal), fluid).lower;
      const double          upper    = leak(discs(radius - diagonal), fluid).upper;
      EXPECT_LE(lower, exact);
      EXPECT_GE(upper, exact);
      EXPECT_LT(upper, 1.06 * lower);
    }

    TEST(FlowClosedForms, ImpermeableDiscs)
    {
      const double        f = 0.3, exact = 0.537580, radius = std::sqrt(f / pi);
      std::vector<double> errors;
      for (const int n : {128, 512})
        {
          // The interpolant finds the rim where the gap changes its sign.
          const SlabField gap = sample(
            [=](const double x, const double y) {
              const double distance = std::hypot(x - .5, y - .5) - radius;
              return distance > 0 ? 1. : -1.;
            },
            n,
            n);
          const Leakage flow = leak(gap, plain_fluid(2e-3));
          errors.push_back(std::abs(flow.rate / exact - 1));
        }
      EXPECT_LT(errors[1], .01);
      EXPECT_LT(errors[1], .6 * errors[0]);
    }

    // The gap is a product A(x) B(y), so that the pressure depends on x alone and the
    // exact resistance is an integral.
    TEST(FlowClosedForms, ParabolicConstriction)
    {
      const double t = 2., length = 1., width = .4;
      const double q = 1 + t * t;
      const double resistance =
        length / width * (35. / 32) * 2 *
        (t / (4 * q * q) + 3 * t / (8 * q) + 3. / 8 * std::atan(t));
      const auto gap = [=](double x, double y) {
        x -= t * length;
        y -= .5;
        return (1 + x * x / (length * length)) * (1 - y * y / (width * width));
      };
      const Leakage flow =
        leak(sample(gap, 512, 256, 2 * t * length, 1.), plain_fluid(1e-3));
      expect_contains(flow, 1. / resistance);
      EXPECT_LT(flow.relative_width(), 1e-3);
      EXPECT_NEAR(flow.rate * resistance, 1., 2e-3);
    }

    // One open grid point is a channel, however far its walls overlap beside it.
    TEST(FlowClosedForms, OnePointWideChannelLeaks)
    {
      std::vector<double> leaks;
      for (const double wall : {0., -1e-2, -1., -1e6})
        {
          const SlabField gap =
            sample([=](const double, const double y) { return y == .5 ? .01 : wall; },
                   64,
                   64);
          const Leakage flow = leak(gap, plain_fluid(1e-2));
          EXPECT_EQ(flow.status, "ok");
          EXPECT_GT(flow.lower, 0.);
          leaks.push_back(flow.rate);
        }
      // About g³ on a width of one spacing; how far the walls overlap hardly matters.
      EXPECT_LT(leaks[0], 1e-6 / 64);
      EXPECT_GT(leaks[1], .1 * leaks[0]);
      EXPECT_LT(leaks[2], 2. * leaks[1]);
      EXPECT_GT(leaks[2], .5 * leaks[1]);
      EXPECT_NEAR(leaks[3] / leaks[2], 1., .1);
    }

    TEST(FlowClosedForms, BoundsAreMonotoneOnNestedMeshes)
    {
      const auto gap = [](const double x, const double y) {
        return 0.55 + .3 * std::cos(2 * pi * x) +
               .3 * std::cos(2 * pi * y) * std::cos(4 * pi * (x + y));
      };
      double     lower = 0., upper = 1e300;
      int        n_meshes = 0;
      const auto check    = [&](const Leakage &flow) {
        // Cells below the grid spacing integrate the gap more finely, hence the factor.
        EXPECT_LE(flow.mesh_upper, upper * (1 + 1e-5));
        EXPECT_GE(flow.mesh_lower, lower * (1 - 1e-5));
        EXPECT_LE(flow.mesh_lower, flow.mesh_upper);
        lower = flow.mesh_lower;
        upper = flow.mesh_upper;
        ++n_meshes;
      };
      leak(sample(gap, 128, 128), plain_fluid(2e-3), check);
      EXPECT_GE(n_meshes, 3);
    }

    // The potential is interpolated from cells larger than those of the grid, of either
    // degree, on a mesh that is distributed over the ranks.
    TEST(FlowClosedForms, PressureFallsEvenlyInAUniformGapParallel)
    {
      for (const unsigned int degree : {1U, 2U})
        for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
          {
            FluidParameters fluid = plain_fluid();
            fluid.element_degree  = degree;
            fluid.direction       = direction;
            const SlabField gap =
              sample([](double, double) { return .1; }, 64, 48, 2., 1.);
            const GivenGap given(gap, fluid);
            ReynoldsSolver solver(fluid, given.field);
            solver.run(given.channel);
            const SlabField potential = potential_on_grid(solver, gap.layout_pointer());
            for (int row = 0; row < gap.layout().n_rows(); ++row)
              for (int ix = 0; ix < 64; ++ix)
                {
                  const int iy = gap.layout().first_row() + row;
                  EXPECT_NEAR(potential(ix, row),
                              1. - (direction == FlowDirection::x ? ix / 64. : iy / 48.),
                              1e-8)
                    << ix << ' ' << iy << ", degree " << degree;
                }
          }
    }
  } // namespace
} // namespace strait
