// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/self_affine_surface.h>
#include <strait/surface/statistics.h>

#include <gtest/gtest.h>

#include <cmath>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;

  SurfaceStatistics
  statistics_of(const SurfaceParameters &parameters, const int nx, const int ny)
  {
    return statistics(make_surface(
      parameters,
      make_layout({nx, ny, parameters.size[0], parameters.size[1]}, MPI_COMM_WORLD)));
  }

  TEST(SurfaceStatistics, OfTheSquareSaddle)
  {
    SurfaceParameters parameters;
    parameters.kind      = SurfaceKind::square_saddle;
    parameters.size      = {{3., 3.}};
    parameters.amplitude = 0.2;
    const auto result    = statistics_of(parameters, 24, 18);
    EXPECT_NEAR(result.rms_height, 0.2, 1e-14);
    EXPECT_NEAR(result.rms_slope, 0.2 * 2 * M_PI / 3, 1e-13);
    EXPECT_NEAR(result.curvature_radius, 0.035823 * 9 / 0.2, 5e-5);
    EXPECT_NEAR(result.rms_curvature * result.curvature_radius, 1., 1e-14);
    EXPECT_NEAR(result.highest, 0.8, 1e-14);
    EXPECT_NEAR(result.lowest, 0., 1e-14);
  }

  TEST(SurfaceStatistics, OfAWaveInARectangle)
  {
    SurfaceParameters parameters;
    parameters.kind      = SurfaceKind::sine;
    parameters.size      = {{0.5, 2.}};
    parameters.amplitude = 0.2;
    const double q       = 2 * M_PI / 0.5;
    const auto   result  = statistics_of(parameters, 15, 7);
    EXPECT_NEAR(result.rms_height, 0.2 / std::sqrt(2.), 1e-14);
    EXPECT_NEAR(result.rms_slope, 0.2 * q / std::sqrt(2.), 1e-13);
    EXPECT_NEAR(result.rms_curvature, 0.2 * q * q / 2, 1e-11);
  }

  TEST(SurfaceStatistics, OfNothing)
  {
    SurfaceParameters parameters;
    parameters.kind   = SurfaceKind::flat;
    const auto result = statistics_of(parameters, 8, 8);
    EXPECT_EQ(result.rms_height, 0.);
    EXPECT_EQ(result.rms_slope, 0.);
    EXPECT_TRUE(std::isinf(result.curvature_radius));
  }

  TEST(Resolution, CountsGridPointsPerShortestWave)
  {
    SurfaceParameters parameters; // short cut-off 1/128
    EXPECT_TRUE(check_resolution(parameters, {512, 512, 1., 1.}).empty());
    EXPECT_TRUE(check_resolution(parameters, {512, 1024, 1., 1.}).empty());

    const auto warnings = check_resolution(parameters, {511, 1024, 1., 1.});
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(mentions(warnings[0], "3.99 grid points"));
    EXPECT_TRUE(mentions(warnings[0], "Contact/Grid points = 512, 512"));
    EXPECT_EQ(check_resolution(parameters, {256, 256, 1., 1.}).size(), 1U);

    EXPECT_TRUE(mentions(input_error([&]() {
                           check_resolution(parameters, {255, 512, 1., 1.});
                         }),
                         "Contact/Grid points = 256, 256"));
    parameters.size = {{3., 1.}};
    EXPECT_TRUE(mentions(input_error([&]() {
                           check_resolution(parameters, {256, 256, 3., 1.});
                         }),
                         "Contact/Grid points = 768, 256"));
  }

  TEST(Resolution, ConcernsSelfAffineSurfacesOnly)
  {
    SurfaceParameters parameters;
    parameters.kind = SurfaceKind::square_saddle;
    EXPECT_TRUE(check_resolution(parameters, {16, 16, 1., 1.}).empty());
  }
} // namespace
