// SPDX-License-Identifier: GPL-2.0-or-later
// The error budget: what coarser grids tell of leak rates and transitions.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    TEST(ErrorBudget, WithoutItTheErrorOfTheGridIsNotKnown)
    {
      Scene scene               = saddle_scene(64);
      scene.programme.pressures = {1.};
      SilentSweep silent(scene);
      int         n_steps = 0;
      silent.loads.run([&n_steps](const Step &step) {
        ++n_steps;
        const ErrorItem &unknown = step.errors.items.at(0);
        EXPECT_EQ(unknown.source, "contact grid");
        EXPECT_TRUE(std::isnan(unknown.relative));
        EXPECT_EQ(unknown.parameter, "Output/Error budget");
        Log loud(MPI_COMM_WORLD, false);
        testing::internal::CaptureStdout();
        report_step(step, 1, loud);
        const std::string said = testing::internal::GetCapturedStdout();
        EXPECT_NE(said.find("  largest known error of the leak rate: mesh, "), said.npos);
        EXPECT_NE(said.find(
                    "; that of the contact grid is not known (Output/Error budget)"),
                  said.npos);
      });
      EXPECT_EQ(n_steps, 1);
    }

    TEST(ErrorBudget, SaysThatItKnowsNothingOfAnOddGrid)
    {
      Scene scene               = saddle_scene(63);
      scene.programme.pressures = {1.};
      scene.output.error_budget = true;
      SilentSweep                    silent(scene);
      const std::vector<std::string> warnings = silent.log.warnings();
      ASSERT_EQ(warnings.size(), 1U);
      EXPECT_NE(warnings[0].find("that of the contact grid is not known"),
                std::string::npos);
      scene.contact.grid_points = {{64, 64}};
      EXPECT_TRUE(SilentSweep(scene).log.warnings().empty());
    }

    // If states depend on their path, the coarser grid follows the same path by itself.
    TEST(ErrorBudget, FollowsThePathOnCoarserPoints)
    {
      Scene rough;
      rough.surface.short_cut_off_wavelength   = .125;
      rough.programme.pressures                = {.05, .1, .06};
      Scene pressed                            = rough;
      pressed.fluid.feedback.enabled           = true;
      pressed.fluid.inlet_pressure             = .02;
      pressed.programme.find_threshold         = true;
      pressed.programme.threshold_tolerance    = 1e-2;
      pressed.programme.reduced_loads          = {.5};
      Scene yielding                           = rough;
      yielding.contact.yields                  = true;
      yielding.contact.hardness                = .5;
      Scene adhesive                           = saddle_scene();
      adhesive.programme.pressures             = {.9, 1.};
      adhesive.contact.adhesion.enabled        = true;
      adhesive.contact.adhesion.surface_energy = .1;
      adhesive.contact.adhesion.tabor_number   = 1.;
      for (Scene scene : {pressed, yielding, adhesive})
        {
          scene.contact.grid_points = {{64, 64}};
          const Sweep plain         = run_sweep(scene);
          scene.output.error_budget = true;
          const Sweep coarse        = run_sweep(scene);
          scene.output.error_budget = false;
          scene.contact.grid_points = {{128, 128}};
          const Sweep fine          = run_sweep(scene);
          ASSERT_EQ(coarse.rows.size(), fine.rows.size());
          for (std::size_t k = 0; k < fine.rows.size(); ++k)
            {
              EXPECT_EQ(coarse.rows[k].leak_rate, plain.rows[k].leak_rate);
              EXPECT_LT(std::abs(fine.rows[k].leak_rate / coarse.rows[k].leak_rate - 1.),
                        coarse.rows[k].error);
              EXPECT_LT(coarse.rows[k].error, 1.);
            }
          for (std::size_t k = 0; k < fine.thresholds.size(); ++k)
            {
              const Transition &found = coarse.thresholds[k];
              EXPECT_LT(std::abs(fine.thresholds[k].middle() / found.middle() - 1.),
                        found.grid_error);
              EXPECT_LT(found.grid_error, .3);
              EXPECT_TRUE(std::isnan(plain.thresholds[k].grid_error));
            }
        }
    }

    // Every second point parts two steps before the grid itself.
    TEST(ErrorBudget, GoesOnWhereCoarserPointsHaveParted)
    {
      Scene scene;
      scene.surface.short_cut_off_wavelength = .125;
      scene.contact.grid_points              = {{64, 64}};
      scene.contact.adhesion.enabled         = true;
      scene.contact.adhesion.surface_energy  = .02;
      scene.contact.adhesion.tabor_number    = 1.;
      scene.programme.pressures              = {.05, -.07, -.0802, -.0805};
      scene.output.error_budget              = true;
      const Sweep found                      = run_sweep(scene);
      ASSERT_EQ(found.rows.size(), 4U);
      EXPECT_TRUE(std::isfinite(found.rows[1].error));
      for (const std::size_t k : {2, 3})
        {
          EXPECT_GT(found.rows[k].leak_rate, 0.);
          EXPECT_TRUE(std::isnan(found.rows[k].error));
        }
    }

    // Both grids then report the outlet pressure, which tells nothing about the error.
    TEST(ErrorBudget, ABlowOutOfASealThatLeaksHasNone)
    {
      Scene scene                         = saddle_scene(64);
      scene.programme.pressures           = {.5};
      scene.programme.find_blow_out       = true;
      scene.programme.find_resealing      = true;
      scene.programme.threshold_tolerance = 1e-2;
      scene.fluid.feedback.enabled        = true;
      scene.fluid.inlet_pressure          = .04;
      scene.fluid.outlet_pressure         = .02;
      scene.output.error_budget           = true;
      SilentSweep   silent(scene);
      const BlowOut found = silent.loads.find_blow_outs().at(0);
      EXPECT_EQ(found.opening.upper, .02);
      EXPECT_TRUE(std::isnan(found.opening.grid_error));
      EXPECT_TRUE(std::isnan(found.closing->grid_error));
    }

    // Two grids may agree by chance, three hardly do.
    TEST(ErrorBudget, ABlowOutIsComparedOnThreeGrids)
    {
      Scene scene                            = saddle_scene(128);
      scene.surface                          = SurfaceParameters();
      scene.surface.seed                     = 21;
      scene.surface.roll_off_wavelength      = .5;
      scene.surface.short_cut_off_wavelength = .125;
      scene.programme.pressures              = {.3045};
      scene.programme.find_blow_out          = true;
      scene.programme.threshold_tolerance    = 1e-2;
      scene.fluid.feedback.enabled           = true;
      scene.fluid.inlet_pressure             = .02;
      std::vector<double> found;
      double              error = 0.;
      for (const int n : {32, 64, 128})
        {
          scene.contact.grid_points = {{n, n}};
          scene.output.error_budget = n == 128;
          SilentSweep      silent(scene);
          const Transition opening = silent.loads.find_blow_outs().at(0).opening;
          found.push_back(opening.middle());
          error = opening.grid_error;
        }
      const double by_second = 3. * std::abs(found[1] / found[2] - 1.),
                   by_fourth = .5 * std::abs(found[0] / found[1] - 1.);
      EXPECT_LT(by_second, .5 * by_fourth); // agree by chance here
      EXPECT_NEAR(error, by_fourth, .1 * by_fourth);
    }

    // On every second row, these grooves have the same height and are always sealed.
    TEST(ErrorBudget, SaysWhereFewerPointsDoNotLeak)
    {
      Scene scene                         = saddle_scene(64);
      scene.surface.kind                  = SurfaceKind::expression;
      scene.surface.expression            = "0.01*cos(64*pi*y)";
      scene.contact.yields                = true;
      scene.contact.hardness              = 10.;
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = 1e-2;
      scene.output.error_budget           = true;
      SilentSweep       silent(scene);
      const Transition &found = silent.loads.find_thresholds().at(0);
      EXPECT_GT(found.lower, 0.);
      EXPECT_TRUE(std::isnan(found.grid_error));
      ASSERT_EQ(silent.log.warnings().size(), 1U);
      EXPECT_EQ(silent.log.warnings()[0].find("on 32 × 32 points, with which"), 0U)
        << silent.log.warnings()[0];
    }
  } // namespace
} // namespace strait
