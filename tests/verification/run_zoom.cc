// SPDX-License-Identifier: GPL-2.0-or-later
// Leak rates of contacts whose throats are resolved by windows of finer points.
#include <strait/run/result_tables.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    Scene
    zoomed(Scene scene)
    {
      scene.contact.zoom.enabled  = true;
      scene.fluid.target_accuracy = .02;
      return scene;
    }

    void
    expect_resolved(const std::vector<Row> &rows, const Scene &scene)
    {
      for (const Row &row : rows)
        {
          EXPECT_EQ(row.status, "ok") << row.reduced_load;
          EXPECT_GE(row.points, 12.) << row.reduced_load;
          EXPECT_LT(row.error, scene.fluid.target_accuracy) << row.reduced_load;
          EXPECT_GT(row.error, 0.) << row.reduced_load;
        }
    }

    /** The exponent of a quantity with the values @p a and @p b at two reduced loads. */
    double
    slope(const double a, const double b, const Row &at_a, const Row &at_b)
    {
      return std::log(a / b) / std::log(at_a.reduced_load / at_b.reduced_load);
    }

    // Windows are placed with half the digits; the state that is returned has all of
    // them, whether its windows are new or not.
    TEST(ZoomedSaddle, IsSolvedToAllDigits)
    {
      Scene scene               = zoomed(saddle_scene(64));
      scene.programme.pressures = {1., 1.3, 1.301};
      SilentSweep silent(scene);
      EXPECT_TRUE(silent.loads.run([&scene](const Step &step) {
        EXPECT_LE(step.state.contact->residual, scene.contact.tolerance);
        EXPECT_FALSE(step.state.gap().layout().windows().empty());
      }));
    }

    // Another slip length moves the throat.
    TEST(ZoomedSurface, EachSlipLengthHasItsOwnWindows)
    {
      Scene scene;
      scene.surface.short_cut_off_wavelength = .1;
      scene.contact.grid_points              = {{64, 64}};
      scene.programme.pressures              = {.15};
      scene.fluid.slip_lengths               = {0., -.0045};
      scene                                  = zoomed(scene);
      const std::vector<Row> both            = sweep(scene);
      ASSERT_EQ(both.size(), 2U);
      EXPECT_GE(both[1].points, 12.);
      scene.fluid.slip_lengths = {-.0045};
      const Row alone          = sweep(scene).front();
      EXPECT_NEAR(both[1].leak_rate / alone.leak_rate, 1., both[1].error + alone.error);
    }

    // Compare with grids of 3456² and 1024² points everywhere.
    TEST(ZoomedSaddle, ClosesAsOnAFineGridParallel)
    {
      Scene scene                         = zoomed(saddle_scene(256));
      scene.programme.pressures           = {};
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = 1e-6;
      scene.programme.reduced_loads       = {.1, .01, .001};
      const Sweep result                  = run_sweep(scene);
      ASSERT_EQ(result.thresholds.size(), 1U);
      EXPECT_LE(result.thresholds[0].relative_width(), 1e-6);
      EXPECT_NEAR(result.thresholds[0].middle() / (.228604 * 2 * pi), 1., 5e-6);
      EXPECT_LE(result.thresholds[0].n_solves, 20);

      const std::vector<Row> &rows = result.rows;
      ASSERT_EQ(rows.size(), 3U);
      expect_resolved(rows, scene);
      // From 768² points with windows, at the same reduced loads.
      const double leak_rate[] = {1.8303e-4, 5.1331e-8, 1.8608e-11};
      for (int k = 0; k < 3; ++k)
        {
          EXPECT_NEAR(rows[k].leak_rate / leak_rate[k], 1., rows[k].error);
        }
      EXPECT_NEAR(rows[0].worst_gap / 5.361e-2, 1., 1e-3);
      EXPECT_NEAR(rows[1].worst_gap / 3.179e-3, 1., 5e-3);
      const double gap[]  = {1.227, 1.186};
      const double leak[] = {3.55, 3.44};
      for (int k = 0; k < 2; ++k)
        {
          const Row &wide = rows[k], &narrow = rows[k + 1];
          EXPECT_NEAR(slope(wide.worst_gap, narrow.worst_gap, wide, narrow), gap[k], .01);
          EXPECT_NEAR(slope(wide.leak_rate, narrow.leak_rate, wide, narrow),
                      leak[k],
                      .02);
        }
    }

    // The fluid does not see the last part of the gap: when it ceases to flow, the
    // patches are still apart and all is smooth, so the leak rate vanishes as a power.
    TEST(ZoomedSaddle, ClosesAsACubeWithNegativeSlip)
    {
      Scene scene                         = zoomed(saddle_scene(256));
      scene.programme.pressures           = {};
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = 1e-6;
      scene.programme.reduced_loads       = {.002, .0005};
      scene.fluid.slip_lengths = {-.001, -.01}; // the latter's loads are the smaller ones
      const std::vector<Row> rows = run_sweep(scene).rows;
      ASSERT_EQ(rows.size(), 4U);
      const auto exponent = [&rows](double Row::*quantity, const int k) {
        return slope(rows[k].*quantity, rows[k + 1].*quantity, rows[k], rows[k + 1]);
      };
      EXPECT_NEAR(exponent(&Row::worst_gap, 0), 1., .01);
      EXPECT_NEAR(exponent(&Row::leak_rate, 0), 3., .02);
      EXPECT_NEAR(exponent(&Row::worst_gap, 2), 1.015, .01);
      EXPECT_NEAR(exponent(&Row::leak_rate, 2), 3.03, .02);
    }

    // Three views of one contact; in the first, the throat lies on the seam along the
    // flow.
    TEST(ZoomedSaddle, DirectionAndPlaceDoNotMatterParallel)
    {
      Scene scene                 = zoomed(saddle_scene(128));
      scene.programme.pressures   = {.99 * 1.43636};
      scene.fluid.target_accuracy = .2; // because the grid shifts the critical load
      const Row along_x           = sweep(scene).front();
      scene.fluid.direction       = FlowDirection::y;
      const Row along_y           = sweep(scene).front();
      scene.surface.kind          = SurfaceKind::expression;
      scene.surface.expression    = "2 + cos(2*pi*(x-0.25)) + cos(2*pi*y)";
      scene.fluid.direction       = FlowDirection::x;
      const Row moved             = sweep(scene).front();
      expect_resolved({along_x, along_y, moved}, scene);
      for (const Row &other : {along_y, moved})
        {
          const double allowed = std::min(along_x.error, other.error);
          EXPECT_NEAR(other.leak_rate / along_x.leak_rate, 1., allowed);
          EXPECT_NEAR(other.worst_gap / along_x.worst_gap, 1., 1e-3);
        }
    }

    Scene
    rough(const int seed, const int n, const double short_cut_off_wavelength)
    {
      Scene scene                            = zoomed(Scene());
      scene.surface.kind                     = SurfaceKind::self_affine;
      scene.surface.seed                     = seed;
      scene.surface.hurst_exponent           = .8;
      scene.surface.roll_off_wavelength      = .5;
      scene.surface.short_cut_off_wavelength = short_cut_off_wavelength;
      scene.contact.grid_points              = {{n, n}};
      scene.contact.zoom.points_along_throat = 4.;
      return scene;
    }

    // Steps without a search find the same critical load as the search. On the grid
    // alone, without windows, the contact would seal from 0.1918 on.
    TEST(ZoomedRough, SealsWhereTheSearchSaysWithoutASearch)
    {
      Scene scene                 = rough(7, 64, .125);
      scene.programme.pressures   = {.195, .2};
      const std::vector<Row> rows = sweep(scene);
      ASSERT_EQ(rows.size(), 2U);
      EXPECT_GT(rows[0].lower, 0.);
      EXPECT_EQ(rows[1].leak_rate, 0.);

      scene.programme.pressures           = {};
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = .005;
      const Transition found              = run_sweep(scene).thresholds.front();
      EXPECT_GT(found.lower, .195);
      EXPECT_LT(found.upper, .2);
    }

    // On 8192² points everywhere, the critical load is 0.24170. The throat that closes
    // first is not the one with most of the pressure drop at a little less load: with
    // windows around that one alone, it would be 0.2430.
    TEST(ZoomedRough, SealsWhereTheFirstOfSeveralThroatsCloses)
    {
      Scene scene                         = rough(1, 512, 1. / 128);
      scene.programme.pressures           = {};
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = .002;
      const Transition found              = run_sweep(scene).thresholds.front();
      EXPECT_NEAR(found.middle() / .2417, 1., .001);
    }

    TEST(ZoomedSaddle, DoesNotStateAnErrorThatNoCoarserGridTells)
    {
      Scene scene               = zoomed(saddle_scene(32));
      scene.programme.pressures = {1.};
      const Row row             = run_sweep(scene).rows.front();
      EXPECT_TRUE(std::isnan(row.error));
      EXPECT_EQ(row.status, "inaccurate");
    }

    bool
    has_column(const Scene &scene, const std::string &name)
    {
      const Table<Step> table   = leakage_table(scene);
      const auto       &columns = table.info().columns;
      return std::any_of(columns.begin(), columns.end(), [&](const ColumnInfo &column) {
        return column.is_written && column.name == name;
      });
    }

    TEST(Zoom, HasColumnsOfItsOwn)
    {
      const Scene scene = saddle_scene(64);
      for (const char *name : {"leak_rate_error", "zoom_levels", "points_along_throat"})
        {
          EXPECT_FALSE(has_column(scene, name)) << name;
          EXPECT_TRUE(has_column(zoomed(scene), name)) << name;
        }
    }
  } // namespace
} // namespace strait
