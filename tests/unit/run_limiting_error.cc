// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/simulation.h>

#include <gtest/gtest.h>

#include <string>

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

    /** Whether limiting_error() of @p scene, at an rms slope of 0.5, contains @p text. */
    bool
    says(const Scene &scene, const std::string &text)
    {
      return limiting_error(scene, .5).find(text) != std::string::npos;
    }

    // From doc/paper.md, for 1024²: 15 points at ε = 0.01, and 6.8 at 0.0025.
    TEST(LimitingError, ThroatOfTheSaddle)
    {
      EXPECT_TRUE(says(saddle(1024, .01), "about 15 grid points along the throat"));
      EXPECT_TRUE(says(saddle(512, .0025), "about 3.4 grid points along the throat"));
    }

    // Means of sixteen realisations on 512² points: 3.9 points at ε = 0.2, 1.1 at 0.02.
    TEST(LimitingError, ThroatOfARoughSurface)
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

    TEST(LimitingError, NamesTheLargestError)
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

    // For 2.9 points where 3 are needed, a grid is named, not "1.0 times as many".
    TEST(LimitingError, NamesAGridThatWouldDo)
    {
      const Scene scene = saddle(449, .0025);
      EXPECT_TRUE(says(scene, "about 2.9 grid points along the throat"));
      EXPECT_TRUE(says(scene, "Contact/Grid points = 45"));
    }
  } // namespace
} // namespace strait
