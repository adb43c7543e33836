// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid flows along the valleys of a wave and presses it apart (Shvarts and Yastrebov,
// Tribol. Int. 126, 2018). In a long channel, each cross-section is Westergaard's contact
// under the load minus the fluid pressure there.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "reference/wavy_contact.h"
#include "run_fixture.h"

namespace strait
{
  namespace
  {
    constexpr double amplitude = .1, full_pressure = pi * amplitude; // p*
    constexpr double inlet = .3 * full_pressure;

    /** The mean of @p f between @p lower and @p upper, by the midpoint rule. */
    template <class Function>
    double
    mean_of(const Function &f, const double lower, const double upper, const int n)
    {
      double sum = 0.;
      for (int i = 0; i < n; ++i)
        sum += f(lower + (upper - lower) * (i + .5) / n);
      return sum / n;
    }

    /** The leak rate of the channel by lubrication theory, with a viscosity of 1. */
    double
    lubrication(const double load, const double outlet, const double length)
    {
      const double sections = mean_of(
        [load](const double fluid_pressure) {
          const reference::Westergaard section{amplitude, 1., 1., load - fluid_pressure};
          return mean_of([&](const double x) { return std::pow(section.gap(x), 3); },
                         0.,
                         .5,
                         400);
        },
        outlet,
        inlet,
        400);
      return (inlet - outlet) * sections / (12. * length);
    }

    Sweep
    flow_along(const double length, const double outlet, const std::vector<double> &loads)
    {
      Scene scene                        = saddle_scene(32);
      scene.contact.grid_points          = {{32, static_cast<int>(32 * length)}};
      scene.surface.kind                 = SurfaceKind::expression;
      scene.surface.expression           = ".1 * cos(2*pi*x)";
      scene.surface.size                 = {{1., length}};
      scene.fluid.direction              = FlowDirection::y;
      scene.fluid.viscosity              = 1.;
      scene.fluid.target_accuracy        = .03;
      scene.fluid.inlet_pressure         = inlet;
      scene.fluid.outlet_pressure        = outlet;
      scene.fluid.feedback.enabled       = true;
      scene.fluid.feedback.pool_pressure = outlet;
      scene.programme.pressures          = loads;
      return run_sweep(scene);
    }

    /** Return the load at which the channel seals. The leak rate vanishes as the sixth
     *  power, so its sixth root is extrapolated linearly to zero. */
    double
    sealing_load(const double load,
                 const double leak_rate,
                 const double next_load,
                 const double next_leak_rate)
    {
      const double root = std::pow(leak_rate, 1. / 6),
                   next = std::pow(next_leak_rate, 1. / 6);
      return next_load + (next_load - load) * next / (root - next);
    }

    TEST(LongChannel, LeaksAsLubricationSaysTheMoreSoTheLongerItIs)
    {
      constexpr double load = .7 * full_pressure;
      for (const double length : {8., 16.})
        {
          const double ratio = flow_along(length, 0., {load}).rows[0].leak_rate /
                               lubrication(load, 0., length);
          EXPECT_LT(ratio, 1.) << length;
          EXPECT_GT(ratio, 1. - .2 / length) << length;
        }
    }

    TEST(LongChannel, SealsUnderTheInletPressureMoreWhateverTheOutletHas)
    {
      const double             before = full_pressure * 1.02, last = full_pressure * 1.14;
      std::map<double, double> sealing;
      for (const double outlet : {0., .1 * full_pressure})
        {
          const Sweep sweep = flow_along(8., outlet, {before, last});
          sealing[outlet] =
            sealing_load(before, sweep.rows[0].leak_rate, last, sweep.rows[1].leak_rate);
          EXPECT_NEAR(sealing[outlet],
                      sealing_load(before,
                                   lubrication(before, outlet, 8.),
                                   last,
                                   lubrication(last, outlet, 8.)),
                      .005 * full_pressure)
            << outlet;
          EXPECT_NEAR(sealing[outlet],
                      full_pressure + inlet,
                      .01 * (full_pressure + inlet));
        }
      EXPECT_NEAR(sealing.begin()->second,
                  sealing.rbegin()->second,
                  .005 * full_pressure);
    }
  } // namespace
} // namespace strait
