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
  using test::whole_surface;

  /** A surface that 64² points resolve on the unit square, with up to 16 waves a side. */
  SurfaceParameters
  example(const Amplitudes amplitudes = Amplitudes::gaussian)
  {
    SurfaceParameters parameters;
    parameters.roll_off_wavelength      = 0.25;
    parameters.short_cut_off_wavelength = 0.0625;
    parameters.amplitudes               = amplitudes;
    parameters.seed                     = 42;
    return parameters;
  }

  SurfaceStatistics
  statistics_of(const SurfaceParameters &parameters, const int n)
  {
    return statistics(make_surface(
      parameters,
      make_layout({n, n, parameters.size[0], parameters.size[1]}, MPI_COMM_WORLD)));
  }

  TEST(SelfAffineSurface, IsTheSameOnEveryGrid)
  {
    for (const Amplitudes amplitudes : {Amplitudes::gaussian, Amplitudes::fixed})
      {
        const auto coarse = whole_surface(example(amplitudes), 64, 64);
        const auto fine   = whole_surface(example(amplitudes), 128, 192);
        for (int iy = 0; iy < 64; ++iy)
          for (int ix = 0; ix < 64; ++ix)
            ASSERT_NEAR(coarse[iy * 64 + ix], fine[3 * iy * 128 + 2 * ix], 1e-12);
      }
  }

  TEST(SelfAffineSurface, IsTheDirectSumOfItsWaves)
  {
    // The sum over all waves, on every rank, uses neither the transform nor slabs.
    SurfaceParameters parameters = example();
    parameters.size              = {{1., 0.6}};
    const SelfAffineSurface surface(parameters, MPI_COMM_WORLD);
    const int               nx = 45, ny = 28;
    const auto              heights = whole_surface(parameters, nx, ny);
    for (const auto &[ix, iy] : {std::pair(0, 0), {7, 3}, {20, 27}, {44, 14}})
      {
        double sum = 0;
        for (int kx = -16; kx <= 16; ++kx)
          for (int ky = -10; ky <= 10; ++ky)
            sum +=
              (surface.mode(kx, ky) *
               std::polar(1., 2 * M_PI * (kx * ix / double(nx) + ky * iy / double(ny))))
                .real();
        EXPECT_NEAR(heights[iy * nx + ix], sum, 1e-12);
      }
  }

  TEST(SelfAffineSurface, RealisationIsFrozen)
  {
    // If these numbers change, so do the surfaces of all users.
    const SelfAffineSurface surface(example(), MPI_COMM_WORLD);
    const auto              mode = surface.mode(3, -2);
    EXPECT_NEAR(mode.real(), 2.307956376154888e-04, 1e-15);
    EXPECT_NEAR(mode.imag(), -1.359091740751361e-03, 1e-15);
  }

  TEST(SelfAffineSurface, ModesOfOppositeWavesAreConjugate)
  {
    const SelfAffineSurface surface(example(), MPI_COMM_WORLD);
    for (const auto &[kx, ky] : {std::pair(1, 0), {0, 1}, {3, -5}, {-7, -2}})
      {
        EXPECT_EQ(surface.mode(kx, ky), std::conj(surface.mode(-kx, -ky)));
        EXPECT_NE(surface.mode(kx, ky), surface.mode(kx, -ky + 1));
        EXPECT_NE(surface.mode(kx, ky), 0.);
      }
    EXPECT_EQ(surface.mode(0, 0), 0.);
  }

  TEST(SelfAffineSurface, SeedsDiffer)
  {
    SurfaceParameters parameters = example();
    const auto        one        = whole_surface(parameters, 40, 40);
    parameters.seed              = 43;
    const auto other             = whole_surface(parameters, 40, 40);
    double     product = 0, square = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
      {
        product += one[i] * other[i];
        square += one[i] * one[i];
      }
    // By chance, the correlation is about 1/√(number of waves below the roll-off).
    EXPECT_LT(std::abs(product), 0.5 * square);
    EXPECT_GT(square, 0.);
  }

  TEST(SelfAffineSurface, HasItsShapeAndItsCutOffs)
  {
    const SelfAffineSurface surface(example(), MPI_COMM_WORLD);
    const double            plateau = surface.spectrum(1, 0);
    EXPECT_GT(plateau, 0.);
    EXPECT_EQ(surface.spectrum(0, 0), 0.);
    EXPECT_EQ(surface.spectrum(2, -3), plateau);
    EXPECT_NEAR(surface.spectrum(4, 0), plateau, 1e-14 * plateau);
    for (const auto &[kx, ky] : {std::pair(6, 8), {0, 15}, {-9, 3}})
      EXPECT_NEAR(surface.spectrum(kx, ky) / plateau,
                  std::pow(std::hypot(kx, ky) / 4, -2 * (1 + 0.8)),
                  1e-13);
    EXPECT_GT(surface.spectrum(11, 11), 0.); // 15.6 of 16
    EXPECT_EQ(surface.spectrum(16, 0), 0.);  // on the cut-off
    EXPECT_EQ(surface.spectrum(12, 11), 0.); // 16.3
  }

  TEST(SelfAffineSurface, IsCircularInRectangularBoxes)
  {
    SurfaceParameters parameters = example();
    parameters.size              = {{2., 1.}};
    const SelfAffineSurface surface(parameters, MPI_COMM_WORLD);
    EXPECT_NEAR(surface.spectrum(12, 8),
                surface.spectrum(20, 0),
                1e-13 * surface.spectrum(20, 0));
    EXPECT_NEAR(surface.spectrum(0, 10),
                surface.spectrum(20, 0),
                1e-13 * surface.spectrum(20, 0));
    EXPECT_GT(surface.spectrum(31, 0), 0.);
    EXPECT_EQ(surface.spectrum(32, 0), 0.);
    EXPECT_EQ(surface.spectrum(0, 16), 0.);
  }

  TEST(SelfAffineSurface, FixedAmplitudesHaveTheRmsValueExactly)
  {
    SurfaceParameters parameters = example(Amplitudes::fixed);
    parameters.rms_value         = 0.3;
    EXPECT_NEAR(statistics_of(parameters, 32).rms_slope, 0.3, 1e-13);
    EXPECT_NEAR(statistics_of(parameters, 81).rms_slope, 0.3, 1e-13);
    parameters.rms_is_of_height = true;
    EXPECT_NEAR(statistics_of(parameters, 32).rms_height, 0.3, 1e-13);
    parameters.size = {{1., 0.5}};
    EXPECT_NEAR(statistics_of(parameters, 32).rms_height, 0.3, 1e-13);
  }

  TEST(SelfAffineSurface, GaussianAmplitudesHaveTheRmsValueOnAverage)
  {
    // In each sample, Σ |h~|² q² over some 400 pairs of waves scatters by about 5 %.
    SurfaceParameters parameters  = example();
    double            mean_square = 0, fourth_moment = 0, second_moment = 0;
    const int         n_samples = 64;
    for (int i = 0; i < n_samples; ++i)
      {
        parameters.seed = 1000 + i;
        mean_square += std::pow(statistics_of(parameters, 32).rms_slope, 2) / n_samples;
        const SelfAffineSurface surface(parameters, MPI_COMM_WORLD);
        for (int kx = 1; kx < 4; ++kx)
          {
            const double power = std::norm(surface.mode(kx, 0));
            second_moment += power;
            fourth_moment += power * power;
          }
      }
    EXPECT_NEAR(mean_square, 1., 0.03);
    // |h~|² is exponentially distributed: ⟨|h~|⁴⟩ = 2 ⟨|h~|²⟩².
    EXPECT_NEAR(fourth_moment * 3 * n_samples / (second_moment * second_moment), 2., 0.5);
  }

  TEST(SelfAffineSurface, RefusesBandsWithNoOrTooManyWaves)
  {
    SurfaceParameters parameters        = example();
    parameters.roll_off_wavelength      = 3.;
    parameters.short_cut_off_wavelength = 2.;
    EXPECT_TRUE(mentions(input_error([&]() { whole_surface(parameters, 4, 4); }),
                         "Short cut-off wavelength"));
    parameters.short_cut_off_wavelength = 1e-9;
    EXPECT_TRUE(mentions(input_error([&]() { whole_surface(parameters, 4, 4); }),
                         "Short cut-off wavelength"));
  }
} // namespace
