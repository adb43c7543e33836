// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/slab_field.h>
#include <strait/surface/statistics.h>
#include <strait/theory/radial_spectrum.h>

#include <gtest/gtest.h>

#include <cmath>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;

  SurfaceParameters
  rough(const double hurst)
  {
    SurfaceParameters parameters;
    parameters.hurst_exponent           = hurst;
    parameters.roll_off_wavelength      = .5;
    parameters.short_cut_off_wavelength = 1. / 32;
    return parameters;
  }

  /** 2π ∫ q^power C dq from @p from to @p to, with C = 1 below the roll-off, by Simpson's
   *  rule in ln q. */
  double
  moment(const double hurst, const double power, const double from, const double to)
  {
    const double corner = 4 * M_PI;
    if (from < corner && to > corner)
      return moment(hurst, power, from, corner) + moment(hurst, power, corner, to);
    constexpr int n    = 200;
    const double  step = std::log(to / from) / n;
    double        sum  = 0;
    for (int k = 0; k <= n; ++k)
      {
        const double q      = from * std::exp(k * step);
        const double weight = k == 0 || k == n ? 1. : (k % 2 == 1 ? 4. : 2.);
        const double c      = from < corner ? 1. : std::pow(q / corner, -2 * (1 + hurst));
        sum += weight * 2 * M_PI * step / 3 * c * std::pow(q, power + 1);
      }
    return sum;
  }

  TEST(RadialSpectrum, MomentsOfTheModel)
  {
    const double lowest = 2 * M_PI, highest = 64 * M_PI;
    for (const double hurst : {.3, .8, 1.})
      {
        const RadialSpectrum spectrum = model_spectrum(rough(hurst));
        EXPECT_NEAR(spectrum.sections.front().from, lowest, 1e-12);
        EXPECT_NEAR(spectrum.sections.back().to, highest, 1e-10);
        EXPECT_NEAR(spectrum.slope_square(), 1., 1e-14);
        ASSERT_EQ(spectrum.sections.size(), 2u);
        EXPECT_NEAR(spectrum.sections[1].from, 4 * M_PI, 1e-12);
        const double all = moment(hurst, 3, lowest, highest);
        EXPECT_NEAR(spectrum.height_square(),
                    moment(hurst, 1, lowest, highest) / all,
                    1e-7);
        for (const double q : {2.5 * M_PI, 3.9 * M_PI, 5 * M_PI, 50 * M_PI})
          {
            EXPECT_NEAR(spectrum.slope_square_below(q),
                        moment(hurst, 3, lowest, q) / all,
                        1e-8);
            EXPECT_NEAR(spectrum.height_square_above(q) /
                          (moment(hurst, 1, q, highest) / all),
                        1.,
                        1e-8);
            EXPECT_NEAR(spectrum.wave_number_at(spectrum.slope_square_below(q)) / q,
                        1.,
                        1e-12);
          }
      }
  }

  TEST(RadialSpectrum, ScaledToItsRmsHeight)
  {
    SurfaceParameters parameters = rough(.8);
    parameters.rms_is_of_height  = true;
    parameters.rms_value         = .2;
    EXPECT_NEAR(model_spectrum(parameters).height_square(), .04, 1e-15);
  }

  TEST(RadialSpectrum, WithoutRollOff)
  {
    SurfaceParameters parameters   = rough(.8);
    parameters.roll_off_wavelength = 1.;
    EXPECT_EQ(model_spectrum(parameters).sections.size(), 1u);
  }

  TEST(RadialSpectrum, MeasuredKeepsHeightAndSlope)
  {
    for (const auto &[nx, ny] : {std::pair{72, 66}})
      {
        const SlabField heights =
          make_surface(rough(.8), make_layout({nx, ny, 1., 1.}, MPI_COMM_WORLD));
        const RadialSpectrum spectrum = measured_spectrum(heights);
        const auto           known    = statistics(heights);
        EXPECT_NEAR(std::sqrt(spectrum.height_square()) / known.rms_height, 1., 1e-12);
        EXPECT_NEAR(std::sqrt(spectrum.slope_square()) / known.rms_slope, 1., 1e-12);
        // Nothing lies beyond the shortest wave, except for the rest of its ring.
        EXPECT_LT(spectrum.sections.back().to, 1.03 * 64 * M_PI);
        for (const double q : {20., 100., 150.})
          EXPECT_NEAR(spectrum.wave_number_at(spectrum.slope_square_below(q)) / q,
                      1.,
                      1e-12);
      }
  }

  TEST(RadialSpectrum, MeasuredFollowsTheModel)
  {
    SurfaceParameters parameters        = rough(.8);
    parameters.amplitudes               = Amplitudes::fixed;
    parameters.short_cut_off_wavelength = 1. / 64;
    const RadialSpectrum model          = model_spectrum(parameters);
    const RadialSpectrum measured       = measured_spectrum(
      make_surface(parameters, make_layout({256, 256, 1., 1.}, MPI_COMM_WORLD)));
    for (const double q : {60., 100., 200., 300.})
      {
        EXPECT_NEAR(measured.slope_square_below(q), model.slope_square_below(q), .02);
        EXPECT_NEAR(measured.height_square_above(q) / model.height_square_above(q),
                    1.,
                    .03);
      }
  }

  TEST(RadialSpectrum, OfASingleWave)
  {
    const SlabField heights =
      sample(make_layout({32, 16, 2., 2.}, MPI_COMM_WORLD),
             [](const double x, double) { return .1 * std::cos(2 * M_PI * 5 * x / 2); });
    const RadialSpectrum spectrum = measured_spectrum(heights);
    EXPECT_NEAR(spectrum.height_square(), .005, 1e-15);
    EXPECT_NEAR(spectrum.wave_number_at(.5 * spectrum.slope_square()),
                5 * M_PI,
                .5 * M_PI);
  }

  TEST(RadialSpectrum, RejectsWhatHasNone)
  {
    const SlabField flat(make_layout({16, 16, 1., 1.}, MPI_COMM_WORLD), 2.);
    EXPECT_TRUE(mentions(input_error([&]() { measured_spectrum(flat); }), "flat"));
    SurfaceParameters smooth        = rough(.8);
    smooth.short_cut_off_wavelength = 1.;
    EXPECT_TRUE(mentions(input_error([&]() { model_spectrum(smooth); }), "no wave"));
  }
} // namespace
