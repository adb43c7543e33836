// SPDX-License-Identifier: GPL-2.0-or-later
// Adhesion together with a fluid that presses on the walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    /** The saddle of doc/feedback.md, whose throat is in the middle of the box. */
    Scene
    adhesive_saddle(const int n, const double tabor_number)
    {
      Scene scene                           = saddle_scene(n);
      scene.surface.kind                    = SurfaceKind::expression;
      scene.surface.expression              = "2 - cos(2*pi*x) + cos(2*pi*y)";
      scene.contact.adhesion.enabled        = true;
      scene.contact.adhesion.surface_energy = .1;
      scene.contact.adhesion.tabor_number   = tabor_number;
      scene.fluid.target_accuracy           = .02;
      scene.fluid.feedback.enabled          = true;
      return scene;
    }

    SealState
    last_state(const Scene &scene)
    {
      SilentSweep silent(scene);
      SealState   last;
      EXPECT_TRUE(silent.loads.run([&last](const Step &step) { last = step.state; }));
      return last;
    }

    TEST(CoupledAdhesion, EqualReservoirsOnlyCarryLoad)
    {
      // A uniform pressure deforms no wall: the state is the dry one under the rest of
      // the load, on the same branch.
      constexpr double pressure        = .3;
      Scene            wet             = adhesive_saddle(128, 1.);
      wet.programme.pressures          = {1., 1.1};
      wet.fluid.inlet_pressure         = pressure;
      wet.fluid.outlet_pressure        = pressure;
      wet.fluid.feedback.pool_pressure = pressure;
      Scene dry                        = wet;
      dry.fluid.feedback.enabled       = false;
      dry.fluid.outlet_pressure        = 0.;
      dry.programme.pressures          = {1. - pressure, 1.1 - pressure};
      const SealState pressed = last_state(wet), alone = last_state(dry);
      double          largest = 0;
      for (std::size_t k = 0; k < alone.gap().size(); ++k)
        largest = std::max(largest, std::abs(pressed.gap()[k] - alone.gap()[k]));
      EXPECT_LT(largest, 1e-6); // heights up to 4; the solver's tolerance is 1e-8
      EXPECT_NEAR(pressed.contact->nominal_pressure, 1.1, 1e-9);
      EXPECT_NEAR(pressed.fluid->load, pressure, 1e-12);
      EXPECT_NEAR(pressed.contact->adhesion->adhesive_energy,
                  alone.contact->adhesion->adhesive_energy,
                  1e-8);
    }

    TEST(CoupledAdhesion, FluidRaisesTheLoadAtWhichAnAdhesiveSaddleSeals)
    {
      Scene scene                         = adhesive_saddle(128, 1.);
      scene.programme.pressures           = {};
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = 1e-3;
      scene.fluid.inlet_pressure          = .15;
      const Transition wet                = run_sweep(scene).thresholds.at(0);
      scene.fluid.feedback.enabled        = false;
      const Transition dry                = run_sweep(scene).thresholds.at(0);
      // The mean fluid pressure alone would raise it by half of the inlet pressure.
      EXPECT_GT(wet.middle() - dry.middle(), .5 * .15);
      EXPECT_LT(wet.middle() - dry.middle(), .15);
      EXPECT_LE(wet.relative_width(), 1e-3);
    }

    TEST(CoupledAdhesion, TensionUnderAFluidPullsTheWallsApart)
    {
      Scene scene                = adhesive_saddle(64, .25);
      scene.programme.pressures  = {.2, -2., .2};
      scene.fluid.inlet_pressure = .1;
      SilentSweep              silent(scene);
      std::vector<std::string> statuses;
      silent.loads.run([&](const Step &step) { statuses.push_back(step.status()); });
      // The path ends where the walls part, as that of a dry contact does.
      ASSERT_EQ(statuses.size(), 1u);
      EXPECT_EQ(statuses[0], "ok");
    }

    // The walls part as soon as the fluid has opened the seal, which leaves no open state
    // from which it could close: there is no re-sealing pressure.
    TEST(CoupledAdhesion, PartedWallsAreNoStateToCloseFrom)
    {
      Scene scene                            = adhesive_saddle(48, .5);
      scene.surface                          = SurfaceParameters();
      scene.surface.seed                     = 1;
      scene.surface.roll_off_wavelength      = .5;
      scene.surface.short_cut_off_wavelength = .125;
      scene.contact.adhesion.surface_energy  = .004;
      scene.programme.pressures              = {.3};
      scene.programme.find_blow_out          = true;
      scene.programme.find_resealing         = true;
      scene.programme.threshold_tolerance    = .02;
      SilentSweep   silent(scene);
      const BlowOut found = silent.loads.find_blow_outs().at(0);
      EXPECT_NEAR(found.opening.middle(), .507, .005);
      ASSERT_TRUE(found.closing.has_value());
      EXPECT_TRUE(std::isnan(found.closing->lower));
      EXPECT_TRUE(std::isnan(found.closing->upper));
    }
  } // namespace
} // namespace strait
