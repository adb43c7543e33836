// SPDX-License-Identifier: GPL-2.0-or-later
// From a scene to leak rates: the isolated saddle, and effects that are off.
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
  } // namespace
} // namespace strait
