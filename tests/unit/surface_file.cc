// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;
  using test::TemporaryFile;
  using test::whole_surface;

  /** A matrix on the unit square, in the scene's units. */
  std::string
  matrix(const std::string &rows)
  {
    return "# Width: 1\n# Height: 1\n" + rows;
  }

  SurfaceParameters
  surface_from(const TemporaryFile &file, const double lx = 1., const double ly = 1.)
  {
    SurfaceParameters parameters;
    parameters.kind     = SurfaceKind::file;
    parameters.map.file = file.path;
    parameters.size     = {{lx, ly}};
    return parameters;
  }

  std::string
  complaint(const SurfaceParameters &parameters, const int nx, const int ny)
  {
    return input_error([&]() { whole_surface(parameters, nx, ny); });
  }

  TEST(FileSurface, FirstRowIsTheBottom)
  {
    const TemporaryFile file(matrix("1 2 3\n4 5 6\n7 8 9\n10 11 12\n"));
    EXPECT_EQ(whole_surface(surface_from(file), 3, 4),
              (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  }

  TEST(FileSurface, InvertedAndRotated)
  {
    const TemporaryFile file(matrix("1 2 3\n4 5 6\n"));
    auto                parameters = surface_from(file);
    parameters.invert              = true;
    EXPECT_EQ(whole_surface(parameters, 3, 2),
              (std::vector<double>{-1, -2, -3, -4, -5, -6}));
    parameters.invert = false;
    parameters.rotate = true;
    // The row y = 0 becomes the column x = 0.
    EXPECT_EQ(whole_surface(parameters, 2, 3), (std::vector<double>{1, 4, 2, 5, 3, 6}));
  }

  TEST(FileSurface, GridMustFit)
  {
    const TemporaryFile file(matrix("1 2 3\n4 5 6\n"));
    auto                parameters = surface_from(file);
    EXPECT_TRUE(mentions(complaint(parameters, 3, 3), "Contact/Grid points = 3, 2."));
    EXPECT_TRUE(mentions(complaint(parameters, 2, 3), "Contact/Grid points = 3, 2."));
    parameters.rotate = true;
    EXPECT_TRUE(mentions(complaint(parameters, 3, 2), "Contact/Grid points = 2, 3."));
  }

  TEST(FileSurface, StatedSizeMustBeTheScenes)
  {
    const TemporaryFile file(
      "# Width: 2 mm\n# Height: 30 um\n# Value units: nm\n1 2\n3 4\n");
    EXPECT_EQ(whole_surface(surface_from(file, 2e-3, 3e-5), 2, 2).size(), 4U);
    EXPECT_EQ(whole_surface(surface_from(file, 2.0015e-3, 3e-5), 2, 2).size(), 4U);
    EXPECT_TRUE(
      mentions(complaint(surface_from(file), 2, 2), "Surface/Size = 0.002, 3e-05"));
    EXPECT_TRUE(mentions(complaint(surface_from(file, 2.003e-3, 3e-5), 2, 2),
                         "Surface/Size = 0.002, 3e-05"));
    // Lateral unit says what 1 in the file means, whatever unit the file states.
    auto in_cm             = surface_from(file);
    in_cm.map.lateral_unit = "cm";
    EXPECT_TRUE(mentions(complaint(in_cm, 2, 2), "Surface/Size = 0.02, 0.0003"));
    auto rotated   = surface_from(file, 2e-3, 3e-5);
    rotated.rotate = true;
    EXPECT_TRUE(mentions(complaint(rotated, 2, 2), "Surface/Size = 3e-05, 0.002"));
  }

  // Filling depends on the ratio of the spacings, whether the map or the scene states it.
  TEST(FileSurface, SidesOfTheSceneWhereTheMapStatesNone)
  {
    const std::string text =
      "# Width: 4\n# Height: 1\n"
      "1 2 3 9\n4 nan nan 2\n7 8 1 1\n3 1 12 4\n";
    const std::vector<double> values = {
      1, 2, 3, 9, 4, NAN, NAN, 2, 7, 8, 1, 1, 3, 1, 12, 4};
    const std::string array =
      test::npy(test::dictionary("<f8", "(4, 4)"), test::bytes(values));
    for (const MakePeriodic periodic : {MakePeriodic::no, MakePeriodic::mirror})
      {
        const double n       = periodic == MakePeriodic::mirror ? 2. : 1.;
        const auto   heights = [&](const std::string &content) {
          const TemporaryFile file(content);
          auto                parameters       = surface_from(file, 4. * n, n);
          parameters.map.largest_missing_share = .2;
          parameters.map.make_periodic         = periodic;
          const auto n_points                  = static_cast<int>(4 * n);
          return whole_surface(parameters, n_points, n_points);
        };
        EXPECT_EQ(heights(array), heights(text));
      }
  }

  TEST(FileSurface, BadFilesAreBadOnEveryRank)
  {
    SurfaceParameters missing;
    missing.kind     = SurfaceKind::file;
    missing.map.file = "/no/such/file.npy";
    EXPECT_TRUE(mentions(complaint(missing, 2, 2), "does not exist"));
    const TemporaryFile ragged(matrix("1 2 3\n4 5\n"));
    EXPECT_TRUE(mentions(complaint(surface_from(ragged), 3, 2), "in line 4"));
  }

  TEST(FileSurface, ResampledToTheGridOfTheScene)
  {
    const TemporaryFile file(matrix("1 3 1 3\n1 3 1 3\n"));
    auto                parameters = surface_from(file);
    EXPECT_TRUE(mentions(complaint(parameters, 8, 4), "Surface/Resample = true"));
    parameters.map.resample = true;
    const auto heights      = whole_surface(parameters, 8, 4);
    for (int iy = 0; iy < 4; ++iy)
      for (int ix = 0; ix < 8; ++ix)
        EXPECT_NEAR(heights[iy * 8 + ix],
                    ix % 2 == 1   ? 2.
                    : ix % 4 == 0 ? 1.
                                  : 3.,
                    1e-12);
  }

  TEST(FileSurface, WindowsOfTheMap)
  {
    // Three windows along x, two along y; a column and a row are left over.
    std::string text = "# Width: 13\n# Height: 9\n";
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 13; ++x)
        text += std::to_string(100 * y + x) + (x < 12 ? " " : "\n");
    const TemporaryFile file(text);
    auto                parameters = surface_from(file, 4., 4.);
    parameters.map.windows         = {{3, 2}};
    for (const auto &[seed, first] :
         {std::pair{1, 0.}, std::pair{6, 408.}, std::pair{2, 4.}})
      {
        parameters.seed                   = seed;
        const std::vector<double> heights = whole_surface(parameters, 4, 4);
        for (int i = 0; i < 16; ++i)
          EXPECT_EQ(heights[i], first + 100 * (i / 4) + i % 4);
      }
    parameters.seed = 7;
    EXPECT_TRUE(mentions(complaint(parameters, 4, 4), "numbered from 1 to 6"));
    parameters.seed = 1;
    for (const int n : {4, 14})
      {
        parameters.map.windows = {{n, 1}};
        EXPECT_TRUE(mentions(complaint(parameters, 4, 4), "give fewer of them"));
      }
  }

  TEST(FileSurface, TwoRoughBodies)
  {
    const TemporaryFile first(matrix("1 2 3\n4 5 6\n")),
      second(matrix("10 20 30\n40 50 60\n"));
    auto parameters            = surface_from(first);
    parameters.map.second_file = second.path;
    // The second body is turned over: x becomes −x.
    EXPECT_EQ(whole_surface(parameters, 3, 2),
              (std::vector<double>{11, 32, 23, 44, 65, 56}));
    const TemporaryFile other(matrix("1 2\n3 4\n"));
    parameters.map.second_file = other.path;
    EXPECT_TRUE(mentions(complaint(parameters, 3, 2), other.path));
  }

  TEST(FileSurface, UnitsOfTwoRoughBodies)
  {
    const TemporaryFile plain(matrix("1 2 3\n4 5 6\n")),
      in_nm("# Width: 1 m\n# Height: 1 m\n# Value units: nm\n10 20 30\n40 50 60\n");
    for (const bool swapped : {false, true})
      {
        auto parameters            = surface_from(swapped ? in_nm : plain);
        parameters.map.second_file = swapped ? plain.path : in_nm.path;
        EXPECT_TRUE(mentions(complaint(parameters, 3, 2), "Surface/Height unit"));
        parameters.map.height_unit = parameters.map.lateral_unit = "scene";
        const auto heights = whole_surface(parameters, 3, 2);
        EXPECT_EQ(heights.front(), 11.);
      }
  }
} // namespace
