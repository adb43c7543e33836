// SPDX-License-Identifier: GPL-2.0-or-later
// From a scene to leak rates: the isolated saddle, effects that are off, and the error
// budget.
#include <strait/run/result_tables.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "allocated_memory.h"
#include "run_fixture.h"

namespace strait
{
  namespace
  {
    // Contact areas, gaps and conductivities of the isolated saddle are from an
    // independent computation, accurate to about 0.1 %.
    TEST(SaddleSweep, AgreesWithIndependentNumbersParallel)
    {
      const std::vector<Row> rows = sweep(saddle_scene());
      ASSERT_EQ(rows.size(), 3U);
      const double conductivity[] = {3.092e-3, 4.188e-4, 5.405e-6};
      for (int k = 0; k < 3; ++k)
        {
          EXPECT_NEAR(rows[k].leak_rate / conductivity[k], 1., 2e-3) << k;
          EXPECT_LT(rows[k].upper / rows[k].lower, 1.001) << k;
        }
      EXPECT_NEAR(rows[1].contact_area, .3452, 5e-4);
      EXPECT_NEAR(rows[2].contact_area, .3820, 5e-4);
      EXPECT_NEAR(rows[1].mean_gap / .40927, 1., 1e-3);
      EXPECT_NEAR(rows[2].mean_gap / .36678, 1., 1e-3);
      EXPECT_NEAR(rows[1].worst_gap / .071349, 1., 1e-3);
      EXPECT_NEAR(rows[2].worst_gap / .015868, 1., 2e-3);
    }

    TEST(SaddleSweep, SealsBeyondTheCriticalLoad)
    {
      Scene scene                 = saddle_scene();
      scene.contact.grid_points   = {{128, 128}};
      scene.programme.pressures   = {.228 * 2 * pi, .2295 * 2 * pi};
      const std::vector<Row> rows = sweep(scene);
      EXPECT_GT(rows[0].lower, 0.);
      EXPECT_EQ(rows[1].leak_rate, 0.);
      EXPECT_EQ(rows[1].upper, 0.);
    }

    TEST(SaddleSweep, DirectionOfFlowDoesNotMatterOnASymmetricSurface)
    {
      Scene scene               = saddle_scene();
      scene.contact.grid_points = {{128, 128}};
      scene.programme.pressures = {.2 * 2 * pi};
      // The same mesh in both directions; adaptive meshes break ties differently.
      scene.fluid.uniform_refinement = true;
      scene.fluid.target_accuracy    = .02;
      const Row along_x              = sweep(scene).front();
      scene.fluid.direction          = FlowDirection::y;
      const Row along_y              = sweep(scene).front();
      EXPECT_NEAR(along_x.upper / along_y.upper, 1., 1e-9);
      EXPECT_NEAR(along_x.lower / along_y.lower, 1., 1e-9);
    }

    TEST(SaddleSweep, SlipMovesTheThreshold)
    {
      // At 0.22 p*, the saddle's gap is 0.0159. A negative slip length of half of that
      // or more stops the flow; a tiny one changes nothing.
      Scene scene               = saddle_scene();
      scene.contact.grid_points = {{256, 256}};
      scene.programme.pressures = {.22 * 2 * pi};
      const double without      = sweep(scene).front().leak_rate;
      scene.fluid.slip_lengths  = {-.0081};
      EXPECT_EQ(sweep(scene).front().leak_rate, 0.);
      scene.fluid.slip_lengths = {-1e-6};
      EXPECT_NEAR(sweep(scene).front().leak_rate / without, 1., 5e-3);
    }

    std::vector<std::string>
    columns(const Scene &scene)
    {
      std::vector<std::string> names;
      const Table<Step>        table = leakage_table(scene);
      for (const ColumnInfo &column : table.info().columns)
        if (column.is_written)
          names.push_back(column.name);
      return names;
    }

    bool
    contains(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    TEST(EffectsThatAreOff, HaveNoColumnAndNoMemory)
    {
      Scene scene;
      scene.contact.grid_points          = {{64, 64}};
      scene.surface.kind                 = SurfaceKind::sine;
      const std::vector<std::string> all = {"step",
                                            "branch",
                                            "pressure",
                                            "mean_gap",
                                            "contact_area",
                                            "contact_area_corrected",
                                            "percolates",
                                            "leak_rate",
                                            "leak_rate_lower",
                                            "leak_rate_upper",
                                            "effective_gap",
                                            "worst_constriction_x",
                                            "worst_constriction_y",
                                            "worst_constriction_gap",
                                            "contact_residual",
                                            "contact_iterations",
                                            "fft_pairs",
                                            "cells",
                                            "unknowns",
                                            "refinements",
                                            "flow_iterations",
                                            "contact_seconds",
                                            "flow_seconds",
                                            "status",
                                            "validity"};
      EXPECT_EQ(columns(scene), all);

      const auto memory = [](const Scene &s) {
        Log               log(MPI_COMM_WORLD, true);
        Timers            timers;
        const std::size_t before = allocated_memory();
        LoadSweep         loads(s,
                        SlabField(make_layout({64, 64, 1., 1.}, MPI_COMM_WORLD)),
                        log,
                        timers);
        return allocated_memory() - before;
      };
      Scene dry         = scene;
      dry.fluid.enabled = false;
      for (const char *name : {"leak_rate", "percolates", "cells", "flow_seconds"})
        EXPECT_FALSE(contains(columns(dry), name)) << name;
      EXPECT_TRUE(contains(columns(dry), "contact_area"));
      EXPECT_LT(memory(dry), memory(scene));

      Scene given           = scene;
      given.contact.enabled = false;
      for (const char *name :
           {"pressure", "contact_area", "fft_pairs", "contact_seconds"})
        EXPECT_FALSE(contains(columns(given), name)) << name;
      EXPECT_TRUE(contains(columns(given), "leak_rate"));
    }

    TEST(Sweep, StatusNamesEveryFailureAndDoubt)
    {
      Step step;
      EXPECT_EQ(step.status(), "ok");
      step.doubts = {"uncertain-threshold", "unresolved-throat"};
      EXPECT_EQ(step.status(), "uncertain-threshold+unresolved-throat");
      EXPECT_TRUE(step.converged());
      step.flow.emplace().leakage.status     = "flow-accuracy";
      step.state.contact.emplace().converged = false;
      EXPECT_EQ(
        step.status(),
        "contact-not-converged+flow-accuracy+uncertain-threshold+unresolved-throat");
      EXPECT_FALSE(step.converged());
    }

    TEST(Sweep, ContinuesFromStepToStep)
    {
      // Each step of a programme has the same result as if it were the only one.
      Scene scene                 = saddle_scene();
      scene.contact.grid_points   = {{128, 128}};
      scene.contact.tolerance     = 1e-10;
      const std::vector<Row> rows = sweep(scene);
      scene.programme.pressures   = {scene.programme.pressures[2]};
      const Row alone             = sweep(scene).front();
      EXPECT_NEAR(rows[2].mean_gap / alone.mean_gap, 1., 1e-8);
      EXPECT_NEAR(rows[2].upper / alone.upper, 1., 1e-5);
    }

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
