// SPDX-License-Identifier: GPL-2.0-or-later
// Fluid that a contact cuts off from its reservoirs keeps its mass.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/trapped_wave.h"
#include "reference/wavy_contact.h"
#include "run_fixture.h"

namespace strait
{
  namespace
  {
    constexpr double when_trapped = .2; // load over p*

    TEST(Trapped, ReferenceHasTheValuesOfTheTable)
    {
      // The pressures are from an independent computation.
      const double loads[] = {.5, 1., 2., 5.};
      const struct
      {
        double modulus, slope, pressures[4];
      } rows[] = {{10., 0., {.29136, .77700, 1.74854, 4.6661}},
                  {10., 7., {.29211, .78153, 1.76604, 4.73866}},
                  {1., 0., {.23201, .62397, 1.43707, 4.1219}},
                  {0., 0., {.3, .8, 1.8, 4.8}}};
      for (const auto &row : rows)
        for (int i = 0; i < 4; ++i)
          EXPECT_NEAR((reference::TrappedWave{when_trapped, row.modulus, row.slope}
                         .fluid_pressure(loads[i])),
                      row.pressures[i],
                      1e-5)
            << row.modulus << ' ' << loads[i];
    }

    /** A wave whose crest lies on the reservoirs, so that all fluid is trapped. */
    Scene
    trapped_wave(const int n, const TrappedFluidLaw law, const double modulus)
    {
      Scene scene                        = saddle_scene(n);
      scene.contact.grid_points          = {{n, 4}};
      scene.contact.tolerance            = 1e-9;
      scene.surface.kind                 = SurfaceKind::expression;
      scene.surface.expression           = "cos(2*pi*x)";
      scene.fluid.inlet_pressure         = 0.;
      scene.fluid.feedback.enabled       = true;
      scene.fluid.feedback.tolerance     = 1e-6;
      scene.fluid.feedback.trapped_fluid = law;
      scene.fluid.feedback.bulk_modulus  = modulus;
      scene.programme.pressures          = {};
      for (const double load : {when_trapped, .5, 1., 2., 5., 2., 1., .5, when_trapped})
        scene.programme.pressures.push_back(load * pi);
      return scene;
    }

    struct Point
    {
      double load, pressure, area, mean_gap; // load and pressure over p*
    };

    std::vector<Point>
    path_of(const Scene &scene)
    {
      SilentSweep        silent(scene);
      std::vector<Point> points;
      EXPECT_TRUE(silent.loads.run([&points](const Step &step) {
        EXPECT_TRUE(step.state.fluid->converged) << step.state.control.target;
        points.push_back({step.state.control.target / pi,
                          step.state.fluid->trapped->pressure / pi,
                          step.state.contact->contact_area,
                          step.state.mean_gap});
      }));
      return points;
    }

    /** Expect that the @p points of a path up and down lie on the closed form. */
    void
    compare(const std::vector<Point> &points, const reference::TrappedWave &exact)
    {
      ASSERT_EQ(points.size(), 9U);
      for (const Point &point : points)
        EXPECT_NEAR(point.pressure, exact.fluid_pressure(point.load), 1e-4) << point.load;
      for (std::size_t i = 0; i < points.size() / 2; ++i)
        {
          const Point &up = points[i], &down = points[points.size() - 1 - i];
          EXPECT_NEAR(up.pressure, down.pressure, 1e-5) << up.load;
          EXPECT_NEAR(up.mean_gap, down.mean_gap, 1e-5) << up.load;
        }
    }

    TEST(Trapped, IncompressibleFluidKeepsTheContactParallel)
    {
      const std::vector<Point> points =
        path_of(trapped_wave(512, TrappedFluidLaw::incompressible, 0.));
      compare(points, {when_trapped});
      for (const Point &point : points)
        // To about one grid point at either rim.
        EXPECT_NEAR(point.area, points[0].area, 2.5 / 512) << point.load;
    }

    TEST(Trapped, CompressibleFluidGivesWay)
    {
      for (const double modulus : {10., 1.})
        compare(path_of(trapped_wave(512, TrappedFluidLaw::compressible, modulus * pi)),
                {when_trapped, modulus});
      Scene scene = trapped_wave(512, TrappedFluidLaw::compressible, 10. * pi);
      scene.fluid.feedback.bulk_modulus_slope = 7.;
      compare(path_of(scene), {when_trapped, 10., 7.});
    }

    TEST(Trapped, FluidIsTheSameInAnyUnitOfPressure)
    {
      // As the reservoirs are without pressure, they give no scale for it.
      Scene scene = trapped_wave(128, TrappedFluidLaw::incompressible, 0.);
      const std::vector<Point> in_one = path_of(scene);
      constexpr double         unit   = 1e-4;
      scene.contact.effective_modulus *= unit;
      for (double &load : scene.programme.pressures)
        load *= unit;
      const std::vector<Point> in_other = path_of(scene);
      ASSERT_EQ(in_one.size(), in_other.size());
      for (std::size_t k = 0; k < in_one.size(); ++k)
        {
          EXPECT_NEAR(in_other[k].pressure / unit, in_one[k].pressure, 1e-4) << k;
          EXPECT_NEAR(in_other[k].mean_gap, in_one[k].mean_gap, 1e-4) << k;
        }
      EXPECT_GT(in_one[4].pressure, 4.);
    }

    TEST(Trapped, GasKeepsPressureTimesVolume)
    {
      Scene scene                        = trapped_wave(512, TrappedFluidLaw::gas, 0.);
      scene.fluid.feedback.pool_pressure = .1 * pi;
      const std::vector<Point> points    = path_of(scene);
      for (const Point &point : points)
        EXPECT_NEAR(point.pressure * point.mean_gap,
                    points[0].pressure * points[0].mean_gap,
                    1e-5)
          << point.load;
      EXPECT_GT(points[4].pressure, 10. * points[0].pressure);
    }

    TEST(Trapped, LongStepsAreHalvedWhereFluidIsCutOff)
    {
      Scene scene                            = saddle_scene(64);
      scene.surface.kind                     = SurfaceKind::self_affine;
      scene.surface.seed                     = 3;
      scene.surface.roll_off_wavelength      = .5;
      scene.surface.short_cut_off_wavelength = .125;
      scene.fluid.inlet_pressure             = .02;
      scene.fluid.target_accuracy            = .1;
      scene.fluid.feedback.enabled           = true;
      scene.fluid.feedback.trapped_fluid     = TrappedFluidLaw::compressible;
      scene.fluid.feedback.bulk_modulus      = 5.;
      const auto carried                     = [&](const std::vector<double> &loads) {
        scene.programme.pressures = loads;
        SilentSweep silent(scene);
        FluidState  last;
        EXPECT_TRUE(silent.loads.run([&last](const Step &step) {
          last.load    = step.state.fluid->load;
          last.trapped = step.state.fluid->trapped;
        }));
        // As accurate as asked for, with the uncertainties of all partial steps added up.
        EXPECT_LT(last.trapped->uncertainty, .1 * loads.back());
        return last.load;
      };
      const double in_one = carried({.1, .4}),
                   in_six = carried({.1, .15, .2, .25, .3, .4});
      EXPECT_NEAR(in_one, in_six, .1 * .1 * .4);
      // Without halving, the first would be .019.
      EXPECT_GT(in_one, .04);
    }

    TEST(Trapped, ARegionBesideTheChannelIsPressedShut)
    {
      // Its fluid takes over the contact pressure of a point or two next to open ones.
      // Where these decided on its pressure, no load near closing had a state.
      Scene scene;
      scene.contact.grid_points              = {{64, 64}};
      scene.surface.roll_off_wavelength      = .5;
      scene.surface.short_cut_off_wavelength = .125;
      scene.fluid.inlet_pressure             = 1e-3;
      scene.programme.find_threshold         = true;
      scene.programme.pressures              = {.15};
      const Sweep drained                    = run_sweep(scene);
      scene.fluid.feedback.enabled           = true;
      scene.fluid.feedback.trapped_fluid     = TrappedFluidLaw::incompressible;
      const Sweep       sweep                = run_sweep(scene);
      const Transition &closing              = sweep.thresholds.front();
      EXPECT_TRUE(closing.converged);
      EXPECT_LT(closing.fft_pairs, 1000); // without states 5000
      EXPECT_EQ(sweep.rows.front().status, drained.rows.front().status);
      // The fluid carries a fifth to two fifths of its pressure in the seal.
      EXPECT_GT(closing.lower, drained.thresholds.front().lower);
      EXPECT_LT(closing.upper,
                drained.thresholds.front().upper + scene.fluid.inlet_pressure);
    }

    TEST(Trapped, LiquidTearsWhereTheWallLeavesIt)
    {
      // Without a cavity, the liquid would be under tension and hold the wall.
      Scene scene               = trapped_wave(256, TrappedFluidLaw::incompressible, 0.);
      scene.programme.pressures = {.2 * pi, .1 * pi, .2 * pi};
      const std::vector<Point>     points = path_of(scene);
      const reference::Westergaard dry{1., 1., 1., .1 * pi};
      EXPECT_EQ(points[1].pressure, 0.);
      EXPECT_NEAR(points[1].mean_gap, dry.mean_gap(), 1e-3);
      EXPECT_NEAR(points[2].mean_gap, points[0].mean_gap, 1e-6);
    }
  } // namespace
} // namespace strait
