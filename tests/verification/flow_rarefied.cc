// SPDX-License-Identifier: GPL-2.0-or-later
// Rarefied gases: one-dimensional flow, which can be integrated directly, and rough gaps.
#include <strait/flow/leakage.h>

#include <gtest/gtest.h>

#include <utility>

#include "flow_fixture.h"
#include "helium.h"

namespace strait
{
  namespace
  {
    /** Return @p gas with settings for a leak rate of five digits. */
    FluidParameters
    accurate(FluidParameters gas)
    {
      gas.interpolation   = GapInterpolation::bilinear;
      gas.target_accuracy = 1e-5;
      return gas;
    }

    /** A gap that varies along x alone, on n × 4 points of spacing length/n. */
    SlabField
    strip(const std::function<double(double)> &gap, const int n, const double length)
    {
      return sample(
        [&](const double x, double) { return gap(x); }, n, 4, length, 4. * length / n);
    }

    /** Return the exact leak rate per width of a strip with a piecewise linear gap. */
    double
    exact_leak(const SlabField &gap, const FluidParameters &fluid)
    {
      const RarefiedGas gas(fluid);
      const int         n = gap.grid().nx, steps = 32;
      const double      dx   = gap.grid().lx / n;
      const auto        rise = [&](const double p, const double x) {
        const auto   k = std::min(static_cast<int>(x), n - 1);
        const double g = gap(k, 0) + (x - k) * (gap((k + 1) % n, 0) - gap(k, 0));
        return 12. * fluid.viscosity / (g * g * g) / gas.mobility(g, std::max(p, 0.));
      };
      // Integrate from the outlet, which has the lower pressure, by Runge-Kutta steps.
      const auto inlet_pressure = [&](const double throughput) {
        double       p = fluid.outlet_pressure;
        const double h = 1. / steps, c = throughput * dx;
        for (int i = n * steps; i > 0 && p < 2. * fluid.inlet_pressure; --i)
          {
            const double x  = i * h;
            const double k1 = c * rise(p, x);
            const double k2 = c * rise(p + .5 * h * k1, x - .5 * h);
            const double k3 = c * rise(p + .5 * h * k2, x - .5 * h);
            const double k4 = c * rise(p + h * k3, x - h);
            p += h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
          }
        return p;
      };
      double least = 0., most = 1e-12;
      while (inlet_pressure(most) < fluid.inlet_pressure)
        most *= 2.;
      for (int round = 0; round < 40; ++round)
        {
          const double middle = .5 * (least + most);
          (inlet_pressure(middle) < fluid.inlet_pressure ? least : most) = middle;
        }
      return most / fluid.mean_pressure();
    }

    TEST(FlowRarefied, PlatesAreExact)
    {
      for (const double gap : {1e-4, 1e-6, 1e-7, 1e-9})
        for (const bool slips : {true, false})
          {
            const FluidParameters fluid = accurate(
              slips ? slipping_helium(1e5) : helium(Rarefaction::transitional, 1e5));
            const double r = 6. * .019169 / gap; // slip: 6 λp/g with λp = 0.019169 m Pa
            const double drive =
              slips ? 1e5 * (1.5e5 + r) : RarefiedGas(fluid).drive(gap, 1e5, 2e5);
            const double exact =
              10. * gap * gap * gap / (12. * fluid.viscosity) * drive / 1.5e5;
            const Leakage flow =
              leak(sample([=](double, double) { return gap; }, 32, 32, 1e-3, 1e-2),
                   fluid);
            EXPECT_EQ(flow.status, "ok");
            EXPECT_NEAR(flow.rate / exact, 1., slips ? 2e-5 : 1e-8);
            EXPECT_LT(flow.relative_width(), 1e-4);
            EXPECT_LE(flow.mesh_width, 1e-5);
            Leakage of_plates = flow;
            of_plates.aspect  = .1;
            EXPECT_NEAR(effective_gap(of_plates, fluid) / gap, 1., 1e-8);
            // Of equally narrow points, the last one, half a spacing before the outlet.
            EXPECT_NEAR(flow.knudsen * gap * 1e5 / .019169, 1., .03);
          }
    }

    TEST(FlowRarefied, EffectiveGapOfAFlowFromEitherSideOfAVacuum)
    {
      FluidParameters fluid = helium(Rarefaction::transitional);
      const double    gap   = 1.5e-7;
      Leakage         of_plates;
      of_plates.rate = gap * gap * gap / (12. * fluid.viscosity) *
                       RarefiedGas(fluid).drive(gap, 0., fluid.inlet_pressure) /
                       fluid.mean_pressure();
      EXPECT_NEAR(effective_gap(of_plates, fluid) / gap, 1., 1e-8);
      std::swap(fluid.inlet_pressure, fluid.outlet_pressure);
      of_plates.rate *= -1.;
      EXPECT_NEAR(effective_gap(of_plates, fluid) / gap, 1., 1e-8);
      fluid.inlet_pressure = fluid.outlet_pressure;
      EXPECT_TRUE(std::isnan(effective_gap({}, fluid))); // any gap would do
    }

    // If a gas flows into a vacuum, each of two equal throats takes half of the drop of
    // p², and the second one 1/√2 of that of p.
    TEST(FlowRarefied, SharesOfThePressureAreNotThoseOfItsSquare)
    {
      FluidParameters fluid = plain_fluid();
      fluid.is_gas          = true;
      const SlabField gap =
        strip([](const double x) { return 1. - .9 * std::pow(std::sin(2. * pi * x), 8); },
              128,
              1.);
      const GivenGap given(gap, fluid);
      ReynoldsSolver solver(fluid, given.field);
      solver.run(given.channel);
      const ConstrictionReport report = report_constrictions(given.channel, solver);
      EXPECT_EQ(report.n_constrictions, 2);
      EXPECT_NEAR(report.fraction_at_worst, std::sqrt(.5), 1e-3);
    }

    TEST(FlowRarefied, GapAlongTheFlowConvergesAtSecondOrder)
    {
      const double    length = 1e-3;
      const SlabField gap    = strip(
        [=](const double x) { return 2e-7 * (1. + .7 * std::cos(2. * pi * x / length)); },
        64,
        length);
      for (const bool slips : {true, false})
        {
          FluidParameters fluid =
            accurate(slips ? slipping_helium() : helium(Rarefaction::transitional));
          fluid.uniform_refinement  = true;
          const double        exact = exact_leak(gap, fluid) * gap.grid().ly;
          std::vector<double> errors;
          for (const unsigned int cells : {512, 2048})
            {
              fluid.maximum_unknowns = 2 * cells + 300;
              const Leakage flow     = leak(gap, fluid);
              errors.push_back(std::abs(flow.rate / exact - 1.));
              EXPECT_LE(flow.lower, exact);
              EXPECT_GE(flow.upper, exact);
            }
          EXPECT_LT(errors[1], 1e-4);
          EXPECT_GT(std::log2(errors[0] / errors[1]), 1.7);
        }
    }

    // A channel that is wide, then narrow, and the same reversed. The step between both
    // is one spacing long, which Richardson extrapolation removes. The expected leak
    // rates follow from the closed form of slip flow in two sections in series.
    TEST(FlowRarefied, ChannelsInARowLeakAnotherWayBack)
    {
      const auto leaks_of = [](const bool narrow_last) {
        std::vector<double> leaks;
        for (const int n : {252, 504, 1008})
          {
            const double    length = 126e-3;
            const SlabField gap    = strip(
              [=](const double x) {
                const double from_wide = narrow_last ? x : length - x;
                return from_wide < 125e-3 - .25 * length / n ? 1e-6 : 2e-7;
              },
              n,
              length);
            FluidParameters fluid = accurate(slipping_helium());
            fluid.target_accuracy = 3e-5;
            const Leakage flow    = leak(gap, fluid);
            leaks.push_back(flow.rate * 1e5 * .01 / gap.grid().ly);
          }
        return leaks;
      };
      const auto limit_of = [](const std::vector<double> &leaks) {
        EXPECT_NEAR(std::log2((leaks[1] - leaks[0]) / (leaks[2] - leaks[1])), 1., .1);
        const double first = 2. * leaks[1] - leaks[0], second = 2. * leaks[2] - leaks[1];
        return second + (second - first) / 3.;
      };
      const double forward  = limit_of(leaks_of(true)),
                   backward = limit_of(leaks_of(false));
      EXPECT_NEAR(forward / 1.181399e-5, 1., 1e-4);
      EXPECT_NEAR(backward / 1.052064e-5, 1., 1e-4);
      EXPECT_NEAR(forward / backward, 1.12293, 1e-4);
    }

    // The brackets of a coarse and of a fine mesh contain the leak rate of the fine one.
    TEST(FlowRarefied, RoughGapIsEnclosed)
    {
      const SlabField gap = sample(
        [](const double x, const double y) {
          return 1e-7 * (.55 + .3 * std::cos(2 * pi * x) +
                         .3 * std::cos(2 * pi * y) * std::cos(4 * pi * (x + y)));
        },
        128,
        128);
      for (const Rarefaction kind : {Rarefaction::slip, Rarefaction::transitional})
        {
          FluidParameters fluid = accurate(helium(kind));
          fluid.target_accuracy = 2e-2;
          const Leakage coarse  = leak(gap, fluid);
          fluid.target_accuracy = 5e-4;
          const Leakage fine    = leak(gap, fluid);
          EXPECT_EQ(fine.status, "ok");
          for (const Leakage &one : {coarse, fine})
            {
              EXPECT_LE(one.lower, fine.rate);
              EXPECT_GE(one.upper, fine.rate);
            }
          EXPECT_LE(coarse.mesh_width, 2e-2);
          EXPECT_LE(fine.mesh_width, 5e-4);
          EXPECT_NEAR(coarse.rate / fine.rate, 1., 1e-2);
          EXPECT_LT(fine.relative_width(), .1);
        }
    }
  } // namespace
} // namespace strait
