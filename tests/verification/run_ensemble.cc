// SPDX-License-Identifier: GPL-2.0-or-later
// Realisations of a scene, together and each alone.
#include <strait/base/exceptions.h>
#include <strait/run/simulation.h>
#include <strait/surface/read_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "run_fixture.h"
#include "temporary_folder.h"

namespace strait
{
  namespace
  {
    std::vector<std::string>
    lines_of(const std::string &path)
    {
      std::ifstream            file(path);
      std::vector<std::string> lines;
      for (std::string line; std::getline(file, line);)
        lines.push_back(line);
      return lines;
    }

    /** Write a scene of small surfaces whose critical loads are sought. */
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
      EXPECT_TRUE(run_all_realisations(read_scene(scene_file, overrides), log));
      const auto rows = lines_of(folder + "/all/ensemble.csv");
      ASSERT_EQ(rows.size(), 5U);
      EXPECT_EQ(rows[4].substr(0, 13), "4,4,inverted,");
      // Its throat is too coarse at one of two steps. It has no crossover, and its status
      // says so.
      EXPECT_NE(rows[4].find("nan,nan,nan,unresolved-throat+no-crossover,coarse-throat"),
                std::string::npos)
        << rows[4];
      EXPECT_EQ(lines_of(folder + "/all/ensemble_summary.csv").front(),
                "quantity,mean,standard_deviation,samples,missing");

      // The scene in the folder of a realisation repeats that realisation.
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

      // A run of fewer realisations leaves no results of the others behind.
      const Overrides one = {overrides.front(), "Realisations/Seeds=5"};
      Log             anew(MPI_COMM_WORLD, true);
      EXPECT_TRUE(run_all_realisations(read_scene(scene_file, one), anew));
      EXPECT_EQ(lines_of(folder + "/all/ensemble.csv").size(), 3U);
      EXPECT_FALSE(lines_of(folder + "/all/realisation-2/leakage.csv").empty());
      EXPECT_TRUE(lines_of(folder + "/all/realisation-3/leakage.csv").empty());
    }

    TEST(Ensemble, ASurfaceTurnsWithItsFrame)
    {
      // The box is longer than wide, and the map states no size.
      const test::TemporaryFolder temporary;
      const std::string           folder = temporary.path();
      std::string                 header =
        "{'descr': '<f8', 'fortran_order': False, 'shape': (16, 32), }";
      header.resize(117, ' ');
      std::ofstream map(folder + "/map.npy", std::ios::binary);
      map << std::string("\x93NUMPY\x01\0\x76\0", 10) << header << '\n';
      for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 32; ++column)
          {
            const double height = .1 * std::cos(2 * M_PI * (column / 32. + row / 8.)) +
                                  .05 * std::sin(2 * M_PI * row / 16.);
            map.write(reinterpret_cast<const char *>(&height), sizeof height);
          }
      map.close();
      std::ofstream(folder + "/scene.prm").close();
      const std::vector<Overrides> surfaces = {
        {"Surface/Kind=file",
         "Surface/File=" + folder + "/map.npy",
         "Contact/Grid points="},
        {"Surface/Kind=expression",
         "Surface/Expression=0.1*cos(2*pi*x/2) + 0.02*cos(2*pi*y)",
         "Contact/Grid points=32, 16"},
        {"Surface/Kind=sine", "Surface/Amplitude=0.05", "Contact/Grid points=32, 16"}};
      for (const Overrides &surface : surfaces)
        {
          Overrides overrides = {"Output/Directory=" + folder + "/all",
                                 "Output/Pictures=false",
                                 "Surface/Size=2, 1",
                                 "Load programme/Pressures=0.02",
                                 "Realisations/Seeds=1",
                                 "Realisations/Orientations=as is, rotated"};
          overrides.insert(overrides.end(), surface.begin(), surface.end());
          Log log(MPI_COMM_WORLD, true);
          EXPECT_TRUE(
            run_all_realisations(read_scene(folder + "/scene.prm", overrides), log));
          Row rows[2];
          for (const int number : {1, 2})
            {
              const Scene scene = read_scene(folder + "/all/realisation-" +
                                             std::to_string(number) + "/parameters.prm");
              rows[number - 1]  = run_sweep(scene).rows.front();
            }
          EXPECT_GT(rows[0].contact_area, 0.);
          EXPECT_NEAR(rows[1].mean_gap, rows[0].mean_gap, 1e-6 * rows[0].mean_gap);
          EXPECT_NEAR(rows[1].contact_area, rows[0].contact_area, 1e-6);
          std::filesystem::remove_all(folder + "/all");
        }
    }

    /** The tables of an ensemble, cell by cell. */
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

    // Three realisations on groups of one rank: not all groups have as much to do.
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
        EXPECT_TRUE(run_all_realisations(read_scene(scene_file, overrides), log, resume));
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

      // With --resume, no realisation runs again, whichever ranks ran it.
      MPI_Barrier(MPI_COMM_WORLD);
      EXPECT_EQ(run("/groups", {}, true), groups);
      const Overrides bad = {"Realisations/Ranks each=1000",
                             "Output/Directory=" + folder + "/bad"};
      Log             log(MPI_COMM_WORLD, true);
      EXPECT_THROW(run_all_realisations(read_scene(scene_file, bad), log, false),
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
      EXPECT_TRUE(run_all_realisations(read_scene(scene_file, overrides), log));
      const auto rows = lines_of(folder + "/all/ensemble.csv");
      ASSERT_EQ(rows.size(), 3U);
      EXPECT_NE(rows[1].find("plastic"), std::string::npos) << rows[1];
    }
  } // namespace
} // namespace strait
