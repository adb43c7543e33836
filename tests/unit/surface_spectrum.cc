// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/map_writer.h>
#include <strait/surface/readers/height_map.h>
#include <strait/surface/statistics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::TemporaryFile;

  SurfaceParameters
  self_affine(const double hurst, const double roll_off, const Amplitudes amplitudes)
  {
    SurfaceParameters parameters;
    parameters.size                     = {{2., 2.}};
    parameters.hurst_exponent           = hurst;
    parameters.roll_off_wavelength      = roll_off;
    parameters.short_cut_off_wavelength = 0.04;
    parameters.amplitudes               = amplitudes;
    return parameters;
  }

  SlabField
  heights_of(const SurfaceParameters &parameters, const int n = 256)
  {
    return make_surface(parameters, make_layout({n, n, 2., 2.}, MPI_COMM_WORLD));
  }

  TEST(RadialSpectrum, IntegratesToTheVariance)
  {
    const auto heights = heights_of(self_affine(0.8, 0.5, Amplitudes::gaussian));
    double     sum = 0, modes = 0;
    for (const SpectrumBin &bin : radial_spectrum(heights))
      {
        sum += bin.density * bin.modes * 2 * M_PI * 2 * M_PI / 4.;
        modes += bin.modes;
      }
    EXPECT_NEAR(std::sqrt(sum) / statistics(heights).rms_height, 1., 1e-10);
    EXPECT_NEAR(modes, std::acos(-1.) * 128 * 128, 300); // all wave vectors in the disc
  }

  TEST(RadialSpectrum, SingleWave)
  {
    SurfaceParameters wave;
    wave.kind       = SurfaceKind::expression;
    wave.size       = {{2., 2.}};
    wave.expression = "3*cos(2*pi*4*x)"; // q = 8π: 8 waves in the box
    for (const SpectrumBin &bin : radial_spectrum(heights_of(wave, 64)))
      {
        const bool holds_it =
          bin.q < 8.01 * 2 * M_PI / 2 * 1.08 && bin.q > 8 * 2 * M_PI / 2 / 1.1;
        if (!holds_it)
          EXPECT_LT(bin.density, 1e-20) << bin.q;
        else
          EXPECT_NEAR(bin.density * bin.modes, 4.5 * 4 / (2 * M_PI * 2 * M_PI), 1e-10);
      }
  }

  TEST(SelfAffineFit, RecoversTheLaw)
  {
    for (const double hurst : {0.3, 0.8})
      for (const double roll_off : {0.5, 0.25})
        {
          const auto fit = fit_self_affine(
            radial_spectrum(heights_of(self_affine(hurst, roll_off, Amplitudes::fixed))));
          ASSERT_TRUE(fit);
          EXPECT_NEAR(fit->hurst_exponent, hurst, 0.03);
          EXPECT_LT(fit->hurst_error, 0.03);
          EXPECT_NEAR(2 * M_PI / fit->roll_off / roll_off, 1., 0.1);
          EXPECT_TRUE(fit->has_roll_off);
          EXPECT_LT(fit->q_to, 2 * M_PI / 0.04 * 1.1);
        }
    const auto scattered = fit_self_affine(
      radial_spectrum(heights_of(self_affine(0.8, 0.5, Amplitudes::gaussian))));
    EXPECT_NEAR(scattered->hurst_exponent, 0.8, 0.06);
  }

  TEST(SelfAffineFit, LastRingEndsWithTheGrid)
  {
    for (const int n : {200, 256})
      {
        SurfaceParameters parameters        = self_affine(0.8, 0.25, Amplitudes::fixed);
        parameters.short_cut_off_wavelength = 2. * 2. / n;
        const auto spectrum                 = radial_spectrum(heights_of(parameters, n));
        const auto fit                      = fit_self_affine(spectrum);
        ASSERT_TRUE(fit);
        const SpectrumBin &last = spectrum.back();
        EXPECT_NEAR(last.density / fit->plateau * std::pow(last.q / fit->roll_off, 3.6),
                    1.,
                    0.03);
        EXPECT_NEAR(fit->hurst_exponent, 0.8, 0.008);
        EXPECT_NEAR(fit->q_to / last.q, 1., 1e-12);
      }
  }

  TEST(RadialSpectrum, RoundingDoesNotDecideOnTheLastWaves)
  {
    std::set<double> modes;
    for (const double side : {1., 40., 5.1, 2.2})
      {
        SurfaceParameters wave;
        wave.kind         = SurfaceKind::expression;
        wave.size         = {{side, side}};
        wave.expression   = "cos(2*pi*x/lx)";
        const auto layout = make_layout({26, 26, side, side}, MPI_COMM_WORLD);
        modes.insert(radial_spectrum(make_surface(wave, layout)).back().modes);
      }
    EXPECT_EQ(modes.size(), 1);
  }

  TEST(SelfAffineFit, WithoutRollOffOrWaves)
  {
    const auto fit = fit_self_affine(
      radial_spectrum(heights_of(self_affine(0.8, 2., Amplitudes::fixed))));
    ASSERT_TRUE(fit);
    EXPECT_FALSE(fit->has_roll_off);
    EXPECT_NEAR(fit->hurst_exponent, 0.8, 0.03);
    EXPECT_FALSE(fit_self_affine({}));
    SurfaceParameters flat;
    flat.kind = SurfaceKind::flat;
    flat.size = {{2., 2.}};
    EXPECT_FALSE(fit_self_affine(radial_spectrum(heights_of(flat, 64))));
  }

  TEST(MapWriter, ReadsBackExactly)
  {
    const SlabLayoutPtr layout = make_layout({6, 4, 3., 2.}, MPI_COMM_WORLD);
    SlabField           heights(layout);
    for (int row = 0; row < layout->n_rows(); ++row)
      for (int ix = 0; ix < 6; ++ix)
        heights(ix, row) = 0.1 * ix + layout->first_row() + row;
    for (const std::string unit : {"um", ""})
      {
        const TemporaryFile file("");
        write_netcdf_map(file.path, heights, unit);
        const auto map = read_height_map(file.path);
        EXPECT_EQ(map.nx, 6);
        EXPECT_EQ(map.ny, 4);
        EXPECT_TRUE(map.is_periodic);
        EXPECT_EQ(map.height_unit.name, unit);
        EXPECT_EQ(map.lateral_unit.name, unit);
        EXPECT_EQ((*map.size)[0], 3.);
        for (int iy = 0; iy < 4; ++iy)
          for (int ix = 0; ix < 6; ++ix)
            EXPECT_EQ(map.values[iy * 6 + ix], 0.1 * ix + iy);
      }
    EXPECT_THROW(write_netcdf_map("/no/such/folder/map.nc", heights, "m"),
                 std::runtime_error);
  }
} // namespace
