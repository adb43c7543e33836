// SPDX-License-Identifier: GPL-2.0-or-later
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <cmath>

#include "reference/hertz.h"
#include "reference/wavy_contact.h"

namespace
{
  using namespace strait::reference;

  /** ∫ f from @p a to @p b; the substitution x ~ sin t smooths ends like square roots. */
  template <class Function>
  double
  integral(const Function &f, const double a, const double b)
  {
    const double middle = (a + b) / 2, half = (b - a) / 2;
    const auto   mapped = [&](const double t) {
      return half * std::cos(t) * f(middle + half * std::sin(t));
    };
    return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(mapped,
                                                                         -M_PI / 2,
                                                                         M_PI / 2);
  }

  TEST(Hertz, KnownNumbers)
  {
    const Hertz hertz{0.01, 1., 1.};
    EXPECT_NEAR(hertz.contact_radius(), 0.19574, 5e-6);
    EXPECT_NEAR(hertz.indentation(), 0.038315, 5e-7);
    EXPECT_NEAR(hertz.largest_pressure(), 0.12461, 5e-6);
  }

  TEST(Hertz, PressureCarriesTheForce)
  {
    const Hertz  hertz{3.7, 2.5, 11.};
    const double force =
      integral([&](const double r) { return 2 * M_PI * r * hertz.pressure(r); },
               0.,
               hertz.contact_radius());
    EXPECT_NEAR(force, 3.7, 1e-12);
    EXPECT_EQ(hertz.pressure(1.0001 * hertz.contact_radius()), 0.);
    EXPECT_EQ(hertz.pressure(0.), hertz.largest_pressure());
  }

  Westergaard
  wave_at(const double relative_load)
  {
    const double amplitude = 0.3, wavelength = 1.7, modulus = 5.;
    return {amplitude,
            wavelength,
            modulus,
            relative_load * M_PI * modulus * amplitude / wavelength};
  }

  TEST(Westergaard, KnownNumbersAtHalfLoad)
  {
    const Westergaard wave = wave_at(0.5);
    EXPECT_NEAR(wave.contact_half_width(), wave.wavelength / 4, 1e-12);
    EXPECT_NEAR(wave.gap(wave.wavelength / 2), 0.53284 * wave.amplitude, 5e-6);
    EXPECT_NEAR(wave.mean_gap(), 0.153426 * wave.amplitude, 5e-7);
  }

  TEST(Westergaard, PressureAndGapHaveTheRightMeans)
  {
    for (const double load : {0.01, 0.2, 0.5, 0.9, 0.99})
      {
        const Westergaard wave = wave_at(load);
        const double      a    = wave.contact_half_width();
        const double      mean_pressure =
          integral([&](const double x) { return wave.pressure(x); }, -a, a) /
          wave.wavelength;
        const double mean_gap =
          integral([&](const double x) { return wave.gap(x); }, a, wave.wavelength - a) /
          wave.wavelength;
        EXPECT_NEAR(mean_pressure, wave.nominal_pressure, 1e-10 * wave.nominal_pressure)
          << load;
        EXPECT_NEAR(mean_gap, wave.mean_gap(), 1e-8 * wave.mean_gap()) << load;
      }
  }

  TEST(Westergaard, PressureAndGapNeverOverlap)
  {
    const Westergaard wave = wave_at(0.3);
    for (int i = -50; i <= 150; ++i)
      {
        const double x = i * wave.wavelength / 97;
        EXPECT_EQ(wave.pressure(x) * wave.gap(x), 0.);
        EXPECT_GT(wave.pressure(x) + wave.gap(x), 0.);
        EXPECT_NEAR(wave.pressure(x), wave.pressure(x + wave.wavelength), 1e-12);
      }
  }

  TEST(Westergaard, LimitsOfNoAndFullContact)
  {
    const Westergaard touching = wave_at(0.);
    EXPECT_EQ(touching.contact_half_width(), 0.);
    EXPECT_EQ(touching.mean_gap(), touching.amplitude);
    EXPECT_NEAR(touching.gap(touching.wavelength / 2), 2 * touching.amplitude, 1e-14);

    const Westergaard full = wave_at(1.5);
    EXPECT_NEAR(full.contact_half_width(), full.wavelength / 2, 1e-12);
    EXPECT_EQ(full.mean_gap(), 0.);
    for (const double x : {0., 0.2, 0.85})
      EXPECT_NEAR(full.pressure(x),
                  full.nominal_pressure +
                    full.full_pressure() * std::cos(2 * M_PI * x / full.wavelength),
                  1e-12);
  }

  TEST(WavyContact, LimitsOfTheProductWave)
  {
    EXPECT_NEAR(product_wave::full_pressure(0.1, 2., 3.),
                std::sqrt(2.) * M_PI * 0.15,
                1e-14);
    // At low load, each cell of λ²/2 has one Hertzian contact, on a crest of curvature
    // (2π/λ)² Δ; here λ = Δ = E* = 1.
    const double load  = 1e-4;
    const double force = load * product_wave::full_pressure(1., 1., 1.) / 2;
    const double a     = Hertz{force, 1 / (4 * M_PI * M_PI), 1.}.contact_radius();
    EXPECT_NEAR(product_wave::contact_fraction_at_low_load(load),
                2 * M_PI * a * a,
                1e-12);
    EXPECT_NEAR(product_wave::contact_fraction_at_high_load(1.), 1., 1e-15);
    EXPECT_NEAR(product_wave::contact_fraction_at_high_load(0.9), 0.952254, 1e-6);
  }

  TEST(WavyContact, SquareSaddle)
  {
    EXPECT_NEAR(square_saddle::full_pressure(0.5, 2., 3.), 1.5 * M_PI, 1e-14);
    EXPECT_NEAR(square_saddle::curvature_radius(0.5, 2.), 0.035823 * 8, 5e-6);
  }
} // namespace
