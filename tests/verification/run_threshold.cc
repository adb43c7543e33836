// SPDX-License-Identifier: GPL-2.0-or-later
// The critical load of the isolated saddle and the exponents near it.
#include <strait/base/exceptions.h>
#include <strait/run/ensemble.h>
#include <strait/run/exponent_fit.h>
#include <strait/surface/read_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "run_fixture.h"
#include "temporary_folder.h"

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

    TEST(SaddleThreshold, CriticalLoadsOfThreeGridsAndTheirLimitParallel)
    {
      // Independent values, in units of E* amplitude/wavelength.
      const double        expected[] = {1.436526, 1.436412, 1.436379};
      std::vector<double> found;
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
        }
      // The differences fall as h^p; so does the rest of the series.
      const double ratio = (found[0] - found[1]) / (found[1] - found[2]);
      const double limit = found[2] - (found[1] - found[2]) / (ratio - 1);
      EXPECT_GT(std::log2(ratio), 1.5);
      EXPECT_NEAR(limit, 1.43636, 1e-5);
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

    double
    exponent(const std::vector<Row>                   &rows,
             const std::function<double(const Row &)> &value)
    {
      std::vector<ScalingPoint> points;
      for (const Row &row : rows)
        points.push_back({row.reduced_load, value(row)});
      return fit_exponent(points, 1.).exponent;
    }

    // In the window that 512² resolves; corrections to scaling are part of the numbers.
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
      // Known loads of the first search serve the second.
      scene.fluid.slip_lengths = {-.002};
      EXPECT_LT(slip.n_solves, run_sweep(scene).thresholds[0].n_solves);
      ASSERT_EQ(result.rows.size(), 2U);
      for (const Row &row : result.rows)
        EXPECT_NEAR(row.reduced_load, .01, 1e-9);
      EXPECT_DOUBLE_EQ(result.rows[0].slip_length, -.002);
      EXPECT_LT(result.rows[0].pressure, result.rows[1].pressure);
    }

    std::vector<std::string>
    lines_of(const std::string &path)
    {
      std::ifstream            file(path);
      std::vector<std::string> lines;
      for (std::string line; std::getline(file, line);)
        lines.push_back(line);
      return lines;
    }

    /** A scene of small surfaces whose critical loads are sought. */
    void
    write_ensemble(const std::string &scene_file,
                   const std::string &reduced_loads,
                   const std::string &realisations)
    {
      std::ofstream(scene_file) << "subsection Surface\n"
                                   "  set Short cut-off wavelength = 0.125\n"
                                   "end\n"
                                   "subsection Contact\n"
                                   "  set Grid points = 64\n"
                                   "end\n"
                                   "subsection Load programme\n"
                                   "  set Pressures =\n"
                                   "  set Find threshold = true\n"
                                   "  set Reduced loads = "
                                << reduced_loads
                                << "\n"
                                   "end\n"
                                   "subsection Realisations\n"
                                << realisations
                                << "end\n"
                                   "subsection Output\n"
                                   "  set Pictures = false\n"
                                   "end\n";
    }

    TEST(Ensemble, EachRealisationIsThatSurfaceAlone)
    {
      const test::TemporaryFolder temporary;
      const std::string           folder     = temporary.path();
      const std::string           scene_file = folder + "/scene.prm";
      write_ensemble(scene_file,
                     "0.5, 0.3",
                     "  set Seeds = 3, 4\n"
                     "  set Orientations = as is, inverted\n");
      const Overrides overrides = {"Output/Directory=" + folder + "/all"};
      Log             log(MPI_COMM_WORLD, true);
      EXPECT_TRUE(run_all_realisations(
        scene_file, overrides, read_scene(scene_file, overrides), log));
      const auto rows = lines_of(folder + "/all/ensemble.csv");
      ASSERT_EQ(rows.size(), 5U);
      EXPECT_EQ(rows[4].substr(0, 13), "4,4,inverted,");
      // With a throat too coarse at one of its two steps it has no crossover, and says
      // so.
      EXPECT_NE(rows[4].find("nan,nan,nan,unresolved-throat+no-crossover,coarse-throat"),
                std::string::npos)
        << rows[4];
      EXPECT_EQ(lines_of(folder + "/all/ensemble_summary.csv").front(),
                "quantity,mean,standard_deviation,samples,missing");

      // The scene in the folder of a realisation repeats it.
      const std::string alone = folder + "/all/realisation-4/parameters.prm";
      const Scene       scene = read_scene(alone);
      EXPECT_FALSE(scene.realisations.enabled());
      EXPECT_EQ(scene.surface.seed, 4U);
      EXPECT_TRUE(scene.surface.invert);
      std::istringstream cells(rows[4]);
      std::string        cell;
      for (int column = 0; column < 4; ++column)
        std::getline(cells, cell, ',');
      EXPECT_NEAR(run_sweep(scene).thresholds[0].lower / std::stod(cell), 1., 1e-12);

      // Fewer of them leave nothing of the others behind.
      const Overrides one = {overrides.front(), "Realisations/Seeds=5"};
      Log             anew(MPI_COMM_WORLD, true);
      EXPECT_TRUE(
        run_all_realisations(scene_file, one, read_scene(scene_file, one), anew));
      EXPECT_EQ(lines_of(folder + "/all/ensemble.csv").size(), 3U);
      EXPECT_FALSE(lines_of(folder + "/all/realisation-2/leakage.csv").empty());
      EXPECT_TRUE(lines_of(folder + "/all/realisation-3/leakage.csv").empty());
    }

    /** The tables of an ensemble, word by word. */
    std::vector<std::string>
    words_of_ensemble(const std::string &folder)
    {
      std::vector<std::string> words;
      for (const char *table : {"/ensemble.csv", "/ensemble_summary.csv"})
        for (const std::string &line : lines_of(folder + table))
          {
            std::istringstream cells(line);
            for (std::string cell; std::getline(cells, cell, ',');)
              words.push_back(cell);
          }
      return words;
    }

    // Three realisations on groups of one rank, so that the last group has less to do.
    TEST(Ensemble, GroupsOfRanksWriteTheTablesOfASequenceParallel)
    {
      const test::TemporaryFolder temporary;
      const std::string           folder     = temporary.path();
      const std::string           scene_file = folder + "/scene.prm";
      write_ensemble(scene_file, "0.5", "  set Seeds = 3, 4, 5\n");
      MPI_Barrier(MPI_COMM_WORLD);
      const auto run = [&](const std::string &name, const Overrides &own, bool resume) {
        Overrides overrides = own;
        overrides.push_back("Output/Directory=" + folder + name);
        Log log(MPI_COMM_WORLD, true);
        EXPECT_TRUE(run_all_realisations(
          scene_file, overrides, read_scene(scene_file, overrides), log, resume));
        MPI_Barrier(MPI_COMM_WORLD);
        return words_of_ensemble(folder + name);
      };
      const auto sequence = run("/sequence", {}, false);
      const auto groups   = run("/groups", {"Realisations/Ranks each=1"}, false);
      ASSERT_EQ(sequence.size(), groups.size());
      int n_numbers = 0;
      for (std::size_t k = 0; k < groups.size(); ++k)
        {
          char        *end    = nullptr;
          const double number = std::strtod(sequence[k].c_str(), &end);
          const double other  = std::strtod(groups[k].c_str(), nullptr);
          if (*end != '\0' || std::isnan(number))
            EXPECT_EQ(sequence[k], groups[k]);
          else
            {
              EXPECT_NEAR(other, number, 1e-4 * std::abs(number));
              ++n_numbers;
            }
        }
      EXPECT_GT(n_numbers, 20);

      // What is done is not run again, whichever ranks did it.
      MPI_Barrier(MPI_COMM_WORLD);
      EXPECT_EQ(run("/groups", {}, true), groups);
      const Overrides bad = {"Realisations/Ranks each=1000",
                             "Output/Directory=" + folder + "/bad"};
      Log             log(MPI_COMM_WORLD, true);
      EXPECT_THROW(
        run_all_realisations(scene_file, bad, read_scene(scene_file, bad), log, false),
        InputError);
    }

    TEST(Ensemble, OfTheTheoryAloneKnowsItsLimits)
    {
      const test::TemporaryFolder temporary;
      const std::string           folder     = temporary.path();
      const std::string           scene_file = folder + "/scene.prm";
      std::ofstream(scene_file) << "";
      const Overrides overrides = {"Output/Directory=" + folder + "/all",
                                   "Output/Pictures=false",
                                   "Contact/Enabled=false",
                                   "Contact/Hardness=0.5",
                                   "Fluid/Enabled=false",
                                   "Theory/Enabled=true",
                                   "Theory/Spectrum=surface",
                                   "Surface/Short cut-off wavelength=0.125",
                                   "Contact/Grid points=32",
                                   "Realisations/Seeds=1, 2"};
      Log             log(MPI_COMM_WORLD, true);
      EXPECT_TRUE(run_all_realisations(
        scene_file, overrides, read_scene(scene_file, overrides), log));
      const auto rows = lines_of(folder + "/all/ensemble.csv");
      ASSERT_EQ(rows.size(), 3U);
      EXPECT_NE(rows[1].find("plastic"), std::string::npos) << rows[1];
    }
  } // namespace
} // namespace strait
