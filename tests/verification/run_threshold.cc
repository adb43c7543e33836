// SPDX-License-Identifier: GPL-2.0-or-later
// The critical loads of the isolated saddle and of rough surfaces, their errors, and the
// exponents near them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    Scene
    threshold_scene(const int n, const double tolerance)
    {
      Scene scene                         = saddle_scene(n);
      scene.programme.pressures           = {};
      scene.programme.find_threshold      = true;
      scene.programme.threshold_tolerance = tolerance;
      return scene;
    }

    Scene
    rough_scene(const int n, const double short_cut_off)
    {
      Scene scene                            = threshold_scene(n, 1e-4);
      scene.surface                          = SurfaceParameters();
      scene.surface.roll_off_wavelength      = .5;
      scene.surface.short_cut_off_wavelength = short_cut_off;
      return scene;
    }

    TEST(SaddleThreshold, CriticalLoadsOfThreeGridsAndTheirLimitParallel)
    {
      // Independent values, in units of E* amplitude/wavelength.
      const double        expected[] = {1.436526, 1.436412, 1.436379};
      std::vector<double> found, errors;
      for (const int n : {128, 256, 512})
        {
          const Sweep result = run_sweep(threshold_scene(n, 1e-6));
          ASSERT_EQ(result.thresholds.size(), 1U);
          const Transition &threshold = result.thresholds.front();
          EXPECT_LE(threshold.relative_width(), 1e-6);
          EXPECT_NEAR(threshold.middle(), expected[found.size()], 3e-6);
          EXPECT_NEAR(threshold.contact_area, .402, 3e-3);
          EXPECT_LE(threshold.n_solves, 16);
          found.push_back(threshold.middle());
          errors.push_back(threshold.grid_error);
        }
      // The differences fall as h^p with the spacing h, and so does what is left.
      const double ratio = (found[0] - found[1]) / (found[1] - found[2]);
      const double limit = found[2] - (found[1] - found[2]) / (ratio - 1);
      EXPECT_GT(std::log2(ratio), 1.5);
      EXPECT_NEAR(limit, 1.43636, 1e-5);
      for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_LT(std::abs(limit / found[k] - 1.), errors[k]);
      EXPECT_LT(errors.back(), 2e-3);
    }

    // In a crease, the estimate from the throat is too small, as finer points keep it
    // open: the coarser grid must correct it.
    TEST(CreaseThreshold, ErrorOfTheGridHoldsWhereTheThroatMisleads)
    {
      Scene scene              = threshold_scene(64, 1e-3);
      scene.surface            = SurfaceParameters();
      scene.surface.kind       = SurfaceKind::expression;
      scene.surface.expression = "0.2*(abs(sin(pi*x)) + abs(sin(pi*y)))";

      const Sweep coarse        = run_sweep(scene);
      scene.contact.grid_points = {{128, 128}};
      const Sweep       fine    = run_sweep(scene);
      const Transition &found   = coarse.thresholds.front(),
                       &finer   = fine.thresholds.front();
      EXPECT_GT(finer.middle() / found.middle() - 1., .15);
      EXPECT_GT(found.grid_error, finer.middle() / found.middle() - 1.);
      EXPECT_LT(found.grid_error, 1.);
    }

    TEST(SaddleThreshold, SealsForSureOnlyBeyondWhatFinerPointsMayChange)
    {
      Scene scene                 = threshold_scene(128, 1e-5);
      scene.programme.pressures   = {1.43656, 1.437, 1.44};
      const std::vector<Row> rows = sweep(scene);
      ASSERT_EQ(rows.size(), 3U);
      for (const Row &row : rows)
        EXPECT_EQ(row.leak_rate, 0.);
      EXPECT_EQ(rows[0].status, "uncertain-threshold");
      EXPECT_EQ(rows[1].status, "uncertain-threshold");
      EXPECT_EQ(rows[2].status, "ok");
    }

    // The critical load depends on where the throat lies between the points, so that
    // differences between grids tell too little about its error.
    TEST(RoughThreshold, FinerPointsHaveTheCriticalLoadWithinItsError)
    {
      Scene scene = rough_scene(512, 1. / 16);
      for (const int seed : {1, 2, 3, 4})
        {
          scene.surface.seed        = seed;
          scene.contact.grid_points = {{512, 512}};
          const double fine         = run_sweep(scene).thresholds[0].middle();
          double       error        = .1;
          for (const int n : {128, 256})
            {
              scene.contact.grid_points = {{n, n}};
              const Transition found    = run_sweep(scene).thresholds[0];
              EXPECT_LT(std::abs(fine / found.middle() - 1.), found.grid_error) << seed;
              EXPECT_LT(found.grid_error, error) << seed;
              error = .7 * found.grid_error;
            }
        }
    }

    // The error must be that of the larger spacing.
    TEST(RoughThreshold, LongCellsDoNotMakeItSure)
    {
      Scene scene = rough_scene(256, .25);
      for (const int seed : {2, 4, 6})
        {
          scene.surface.seed        = seed;
          scene.contact.grid_points = {{256, 256}};
          const double fine         = run_sweep(scene).thresholds[0].middle();
          for (const auto &points : {std::array{64, 16}, {16, 64}})
            {
              scene.contact.grid_points = points;
              const Transition found    = run_sweep(scene).thresholds[0];
              EXPECT_LT(std::abs(fine / found.middle() - 1.), found.grid_error) << seed;
              EXPECT_LT(found.grid_error, .15) << seed;
            }
        }
    }

    TEST(SaddleThreshold, FromAboveItIsTheSame)
    {
      Scene        scene         = threshold_scene(128, 1e-4);
      const double loading       = run_sweep(scene).thresholds[0].middle();
      scene.programme.path       = LoadPath::unloading;
      const Transition unloading = run_sweep(scene).thresholds[0];
      EXPECT_NEAR(unloading.middle() / loading, 1., 1e-4);
      EXPECT_LE(unloading.n_solves, 12);
    }

    /** Return β of value ∝ ε^β between the first and the last row, with ε = 1 − L/L_c. */
    double
    exponent(const std::vector<Row>                   &rows,
             const std::function<double(const Row &)> &value)
    {
      return std::log(value(rows.back()) / value(rows.front())) /
             std::log(rows.back().reduced_load / rows.front().reduced_load);
    }

    // At loads that 512² points resolve; corrections to scaling are part of the numbers.
    TEST(SaddleThreshold, ExponentsOfThroatAndLeakRate)
    {
      Scene scene                   = threshold_scene(512, 1e-6);
      scene.programme.reduced_loads = {.02, .014, .01};
      const std::vector<Row> rows   = sweep(scene);
      ASSERT_EQ(rows.size(), 3U);
      const double gap    = exponent(rows, [](const Row &r) { return r.throat.gap; });
      const double width  = exponent(rows, [](const Row &r) { return r.throat.width; });
      const double length = exponent(rows, [](const Row &r) { return r.throat.length; });
      const double leak   = exponent(rows, [](const Row &r) { return r.leak_rate; });
      EXPECT_GT(gap, 1.18);
      EXPECT_LT(gap, 1.215);
      EXPECT_GT(width, .45);
      EXPECT_LT(width, .475);
      EXPECT_GT(length, .575);
      EXPECT_LT(length, .60);
      EXPECT_GT(leak, 3.44);
      EXPECT_LT(leak, 3.52);
    }

    TEST(SaddleThreshold, SlipHasItsOwnThreshold)
    {
      Scene scene                   = threshold_scene(256, 1e-6);
      scene.fluid.slip_lengths      = {0., -.002};
      scene.programme.reduced_loads = {.01};
      const Sweep result            = run_sweep(scene);
      ASSERT_EQ(result.thresholds.size(), 2U);
      const Transition &dry = result.thresholds[0], &slip = result.thresholds[1];
      EXPECT_LT(slip.upper, dry.lower);
      EXPECT_LT(0., slip.grid_error);
      EXPECT_LT(slip.grid_error, .01);
      // The loads that the first search probed serve the second.
      scene.fluid.slip_lengths = {-.002};
      EXPECT_LT(slip.n_solves, run_sweep(scene).thresholds[0].n_solves);
      ASSERT_EQ(result.rows.size(), 2U);
      for (const Row &row : result.rows)
        EXPECT_NEAR(row.reduced_load, .01, 1e-9);
      EXPECT_DOUBLE_EQ(result.rows[0].slip_length, -.002);
      EXPECT_LT(result.rows[0].pressure, result.rows[1].pressure);
    }

    TEST(SaddleThreshold, TellsWhetherItRestsOnStatesThatConverged)
    {
      Scene scene = threshold_scene(32, 1e-3);
      EXPECT_TRUE(run_sweep(scene).thresholds[0].converged);
      scene.contact.maximum_iterations = 4;
      SilentSweep silent(scene);
      EXPECT_FALSE(silent.loads.find_thresholds().front().converged);
      // This counts for the run as well, which has no steps here.
      EXPECT_FALSE(silent.loads.run([](const Step &) {}));
    }
  } // namespace
} // namespace strait
