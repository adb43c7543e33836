// SPDX-License-Identifier: GPL-2.0-or-later
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/manufactured_flow.h"
#include "reference/plate_flow.h"

namespace
{
  using namespace strait::reference;

  /** The mean of a smooth function of period 1; the sum converges exponentially. */
  template <class Function>
  double
  periodic_mean(const Function &f)
  {
    const int n   = 400;
    double    sum = 0;
    for (int i = 0; i < n; ++i)
      sum += f(static_cast<double>(i) / n);
    return sum / n;
  }

  TEST(PlateFlow, OneDimensionalGaps)
  {
    const double g0 = 1.3, epsilon = 0.6;
    const auto   gap = [&](const double x) {
      return g0 * (1 + epsilon * std::cos(2 * M_PI * x));
    };
    const double resistance =
      periodic_mean([&](const double x) { return std::pow(gap(x), -3); });
    const double conductance =
      periodic_mean([&](const double x) { return std::pow(gap(x), 3); });
    EXPECT_NEAR(cubed_gap_along_wave(g0, epsilon), 1 / resistance, 1e-12);
    EXPECT_NEAR(cubed_gap_across_wave(g0, epsilon), conductance, 1e-12);
    EXPECT_EQ(cubed_gap_along_wave(g0, 0.), cubed_gap_across_wave(g0, 0.));
  }

  TEST(PlateFlow, SeparableGap)
  {
    EXPECT_NEAR(cubed_gap_of_product(2., 0.3, 0.4),
                cubed_gap_along_wave(2., 0.3) * cubed_gap_across_wave(1., 0.4),
                1e-13);
    EXPECT_NEAR(cubed_gap_of_product(2., 0.3, 0.), cubed_gap_along_wave(2., 0.3), 1e-13);
    EXPECT_NEAR(cubed_gap_of_product(2., 0., 0.4), cubed_gap_across_wave(2., 0.4), 1e-13);
  }

  TEST(PlateFlow, TwoPhaseMedia)
  {
    EXPECT_DOUBLE_EQ(checkerboard_conductivity(4., 9.), 6.);
    EXPECT_NEAR(conductivity_around_discs(0.3), 0.537580, 1e-6);
    EXPECT_NEAR(conductivity_around_discs(0.5), 0.324657, 1e-6);
    EXPECT_EQ(conductivity_around_discs(0.), 1.);
    // For few discs: Maxwell's formula (1 − f)/(1 + f).
    EXPECT_NEAR(conductivity_around_discs(0.01), 0.99 / 1.01, 1e-8);
  }

  TEST(PlateFlow, ParabolicConstriction)
  {
    const ParabolicConstriction throat{0.2, 3., 0.5, 0.7};
    const double                scale =
      12 * throat.viscosity * throat.length / (throat.width * std::pow(throat.gap, 3));
    EXPECT_NEAR(throat.resistance(std::numeric_limits<double>::infinity()),
                1.28854 * scale,
                1e-5 * scale);

    using boost::math::quadrature::gauss_kronrod;
    const double across = gauss_kronrod<double, 31>::integrate(
      [&](const double y) { return std::pow(1 - std::pow(y / throat.width, 2), 3); },
      -throat.width,
      throat.width);
    for (const double half_length : {0.1, 2., 30.})
      {
        const double along = gauss_kronrod<double, 61>::integrate(
          [&](const double x) {
            return std::pow(1 + std::pow(x / throat.length, 2), -3);
          },
          -half_length,
          half_length);
        const double expected =
          12 * throat.viscosity * along / (across * std::pow(throat.gap, 3));
        EXPECT_NEAR(throat.resistance(half_length), expected, 1e-9 * expected);
      }
  }

  TEST(ManufacturedFlow, BoundaryValues)
  {
    for (const double y : {0., 0.13, 0.5, 0.9})
      {
        EXPECT_NEAR(manufactured_flow::pressure(0., y), 1., 1e-15);
        EXPECT_NEAR(manufactured_flow::pressure(1., y), 0., 1e-15);
      }
    for (const double x : {0.1, 0.6})
      {
        EXPECT_NEAR(manufactured_flow::pressure(x, 0.),
                    manufactured_flow::pressure(x, 1.),
                    1e-15);
      }
    EXPECT_NEAR(manufactured_flow::conductivity(0., 0.), 2.25, 1e-15);
    EXPECT_NEAR(std::pow(manufactured_flow::gap(0.2, 0.7), 3),
                12 * manufactured_flow::conductivity(0.2, 0.7),
                1e-13);
  }

  TEST(ManufacturedFlow, HasNoSources)
  {
    // Central differences of fourth order; their error is near 1e-10 here.
    const double h          = 1e-3;
    const auto   derivative = [h](const auto &f) {
      return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
    };
    const auto flux = [&](const double x, const double y, const double dx) {
      const double dy = 1. - dx;
      return -manufactured_flow::conductivity(x, y) * derivative([&](const double s) {
        return manufactured_flow::pressure(x + s * dx, y + s * dy);
      });
    };
    for (const double x : {0.07, 0.31, 0.83})
      for (const double y : {0.02, 0.44, 0.71})
        EXPECT_NEAR(derivative([&](const double s) { return flux(x + s, y, 1.); }) +
                      derivative([&](const double s) { return flux(x, y + s, 0.); }),
                    0.,
                    1e-6);
  }
} // namespace
