// SPDX-License-Identifier: GPL-2.0-or-later
// Leak rates of gaps whose effective conductivity is known in closed form.
#include <strait/reference/plate_flow.h>

#include <gtest/gtest.h>

#include "flow_fixture.h"

namespace strait
{
  namespace
  {
    void
    expect_bracket(const FlowResult &flow, const double exact, const double slack)
    {
      EXPECT_EQ(flow.status, "ok");
      EXPECT_LE(flow.lower, exact * (1 + slack));
      EXPECT_GE(flow.upper, exact * (1 - slack));
      EXPECT_LE(flow.lower, flow.leak_rate);
      EXPECT_GE(flow.upper, flow.leak_rate);
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
          fluid.direction         = direction;
          const double     aspect = direction == FlowDirection::x ? .5 / 2. : 2. / .5;
          const double     exact  = gap * gap * gap / (12 * .7) * 3. * aspect;
          const FlowResult flow   = leak(plates, fluid);
          EXPECT_NEAR(flow.upper / exact, 1., 1e-8);
          EXPECT_NEAR(flow.lower / exact, 1., 1e-8);
        }
    }

    TEST(FlowClosedForms, ReversedPressureReversesTheLeak)
    {
      FluidParameters fluid = plain_fluid();
      fluid.inlet_pressure  = 0.;
      fluid.outlet_pressure = 1.;
      const FlowResult flow =
        leak(sample([](double, double) { return 1.; }, 32, 32), fluid);
      EXPECT_NEAR(flow.leak_rate, -1., 1e-8);
    }

    // g = 1 + ε cos kx: series resistance along x, mean conductivity along y.
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
          for (const int n : {8, 16, 32})
            {
              // A strip suffices, and with four cells across it costs little.
              const double    ly = 4. / n;
              const SlabField gap =
                sample([=](const double x,
                           double) { return 1 + epsilon * std::cos(2 * pi * x); },
                       n,
                       4,
                       1.,
                       ly);
              const FlowResult flow   = leak(gap, fluid);
              const double     aspect = direction == FlowDirection::x ? ly : 1. / ly;
              EXPECT_LT(flow.relative_width(), 3e-5);
              errors.push_back(std::abs(flow.leak_rate / (exact * aspect) - 1));
            }
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
      const FlowResult flow = leak(sample(gap, 128, 128), plain_fluid(1e-3));
      expect_bracket(flow, along * across, 1e-3);
      EXPECT_NEAR(flow.leak_rate / (along * across), 1., 1e-3);
    }

    // The corners are singular: a case for local refinement.
    TEST(FlowClosedForms, CheckerboardTendsToTheGeometricMean)
    {
      const double        low = 1., high = 2.; // conductivities 1 and 8
      const auto          exact = std::sqrt(1. * 8.);
      std::vector<double> errors;
      for (const int n : {64, 256})
        {
          // The reservoirs must lie on lines of mirror symmetry, so the board is moved
          // by a quarter period; half a spacing more gives both phases equal shares.
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
          const FlowResult flow = leak(board, fluid);
          EXPECT_LT(flow.relative_width(), 5e-3);
          errors.push_back(std::abs(flow.leak_rate / exact - 1));
        }
      EXPECT_LT(errors[1], .02);
      EXPECT_LT(errors[1], .5 * errors[0]);
    }

    TEST(FlowClosedForms, ImpermeableDiscs)
    {
      const double        f = 0.3, exact = 0.537580, radius = std::sqrt(f / pi);
      std::vector<double> errors;
      for (const int n : {128, 512})
        {
          // The sign of the distance tells the interpolant where the rim lies.
          const SlabField gap = sample(
            [=](const double x, const double y) {
              const double distance = std::hypot(x - .5, y - .5) - radius;
              return distance > 0 ? 1. : -1.;
            },
            n,
            n);
          const FlowResult flow = leak(gap, plain_fluid(2e-3));
          errors.push_back(std::abs(flow.leak_rate / exact - 1));
        }
      EXPECT_LT(errors[1], .01);
      EXPECT_LT(errors[1], .6 * errors[0]);
    }

    // The pressure depends on x alone, so the exact resistance is an integral.
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
      const FlowResult flow =
        leak(sample(gap, 512, 256, 2 * t * length, 1.), plain_fluid(1e-3));
      EXPECT_LT(flow.relative_width(), 1e-3);
      EXPECT_NEAR(flow.leak_rate * resistance, 1., 2e-3);
    }

    // However deep the walls of a channel are closed, one point is a channel.
    TEST(FlowClosedForms, OnePointWideChannelLeaks)
    {
      std::vector<double> leaks;
      for (const double wall : {0., -1e-2, -1., -1e6})
        {
          const SlabField gap =
            sample([=](const double, const double y) { return y == .5 ? .01 : wall; },
                   64,
                   64);
          const FlowResult flow = leak(gap, plain_fluid(1e-2));
          EXPECT_EQ(flow.status, "ok");
          EXPECT_GT(flow.lower, 0.);
          leaks.push_back(flow.leak_rate);
        }
      // g³ over a spacing or so; how deep the wall is closed hardly matters.
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
      const auto check    = [&](const FlowResult &flow) {
        // Cells below the grid spacing integrate the same gap more finely.
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
  } // namespace
} // namespace strait
