// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/simulation.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    Scene
    saddle(const int n_points, const double reduced_load)
    {
      Scene scene;
      scene.surface.kind             = SurfaceKind::square_saddle;
      scene.contact.grid_points      = {{n_points, n_points}};
      scene.programme.pressures      = {1.};
      scene.programme.reduced_loads  = {.1, reduced_load};
      scene.programme.find_threshold = true;
      return scene;
    }

    /** Whether a line on @p scene, of rms slope .5, contains @p text. */
    bool
    says(const Scene &scene, const std::string &text)
    {
      for (const std::string &line : predict_cost(scene, .5))
        if (line.find(text) != std::string::npos)
          return true;
      return false;
    }

    // doc/paper.md, 1024²: 15 points at 0.01, 6.8 at 0.0025.
    TEST(CostPrediction, ThroatOfTheSaddle)
    {
      EXPECT_TRUE(says(saddle(1024, .01), "about 15 grid points along the throat"));
      EXPECT_TRUE(says(saddle(512, .0025), "about 3.4 grid points along the throat"));
    }

    // The table of sixteen realisations: 3.9 points at 0.2, 1.1 at 0.02.
    TEST(CostPrediction, ThroatOfARoughSurface)
    {
      Scene scene;
      scene.surface.short_cut_off_wavelength = 16. / 512;
      scene.programme.pressures              = {.19 * .5 * .8, 1.};
      EXPECT_TRUE(says(scene,
                       "about 4.1 grid points along the throat at a reduced load of 0.2 "
                       "(if such a seal closes early)"));
      scene.programme.pressures = {1.};
      EXPECT_TRUE(says(scene, "largest error: not predicted"));
    }

    TEST(CostPrediction, NamesTheLargestError)
    {
      const std::string is_largest = " to be the largest error";
      EXPECT_TRUE(says(saddle(1024, .01), "the mesh is likely" + is_largest));
      EXPECT_TRUE(says(saddle(256, .001), "the contact grid is likely" + is_largest));
      Scene unknown        = saddle(256, .001);
      unknown.surface.kind = SurfaceKind::sphere;
      EXPECT_TRUE(says(unknown, "largest error: not predicted"));
      Scene zoomed                = saddle(512, .001);
      zoomed.contact.zoom.enabled = true;
      EXPECT_TRUE(says(zoomed, "below about 6.1e-05"));
    }

    // 3.9 points where 4 are needed: not "1.0 times as many".
    TEST(CostPrediction, NamesAGridThatWouldDo)
    {
      const Scene scene = saddle(587, .0025);
      EXPECT_TRUE(says(scene, "about 3.9 grid points along the throat"));
      EXPECT_TRUE(says(scene, "Contact/Grid points = 6"));
    }

    // 10 to 40 FFT pairs a contact.
    TEST(CostPrediction, CountsContactsAndCapsUnknowns)
    {
      Scene scene                  = saddle(1024, .01);
      scene.fluid.maximum_unknowns = 3000;
      EXPECT_TRUE(says(scene, "500 to 3000 unknowns a step, at most 3000"));
      // 3 steps, and 7 to 16 solves of the search.
      EXPECT_TRUE(says(scene, "100 to 760 in all"));
      scene.programme.path           = LoadPath::cycle;
      scene.programme.pressures      = {1., 2., 3.};
      scene.programme.find_threshold = false;
      const std::vector<double> near_threshold =
        std::exchange(scene.programme.reduced_loads, {});
      EXPECT_TRUE(says(scene, "50 to 200 in all")) << "5 steps";
      scene.programme.pressures      = {};
      scene.programme.reduced_loads  = near_threshold;
      scene.programme.find_threshold = true;
      scene.fluid.slip_lengths       = {0., -.1, -.2};
      EXPECT_TRUE(says(scene, "130 to 880 in all")) << "two steps near each threshold";
    }
  } // namespace
} // namespace strait
