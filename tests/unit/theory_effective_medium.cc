// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/slab_field.h>
#include <strait/theory/gap_distribution.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
  using namespace strait;

  constexpr double rounding = 1e-13;

  struct MediumPart
  {
    double share, conductivity;
  };

  /** effective_cubed_gap() of parts with given conductivities in place of cubed gaps. */
  double
  effective_conductivity(const std::vector<MediumPart> &medium, const double n)
  {
    GapDistribution gaps;
    for (const auto &[share, conductivity] : medium)
      if (conductivity > 0)
        {
          gaps.fractions.push_back(share);
          gaps.gaps.push_back(std::cbrt(conductivity));
        }
      else
        gaps.contact_area += share;
    return effective_cubed_gap(gaps, n);
  }

  TEST(EffectiveMedium, TwoPhasesInEqualShares)
  {
    for (const double contrast : {2., 1e3, 1e9, 1e15})
      EXPECT_NEAR(effective_conductivity({{.5, 1.}, {.5, contrast}}, 2.) /
                    std::sqrt(contrast),
                  1.,
                  rounding);
  }

  TEST(EffectiveMedium, ImpermeableShare)
  {
    for (const double n : {2., 3., 1 / .58})
      for (const double share : {0., .1, .99 * (1 - 1 / n)})
        {
          const double expected = 1 - share * n / (n - 1);
          // It must not matter if the part that conducts is split into two.
          EXPECT_NEAR(effective_conductivity({{share, 0.}, {1 - share, 5.}}, n) / 5,
                      expected,
                      rounding);
          EXPECT_NEAR(effective_conductivity({{share, 0.},
                                              {.5 * (1 - share), 5.},
                                              {.5 * (1 - share), 5. + 1e-12}},
                                             n) /
                        5,
                      expected,
                      1e-11);
        }
  }

  TEST(EffectiveMedium, VanishesAtTheThreshold)
  {
    for (const double critical : {.3, .42, .5})
      {
        const double n = 1 / (1 - critical);
        EXPECT_EQ(effective_conductivity({{critical + 1e-12, 0.}, {1 - critical, 1.}}, n),
                  0.);
        EXPECT_NEAR(
          effective_conductivity({{critical - 1e-6, 0.}, {1 - critical + 1e-6, 1.}}, n),
          1e-6 / critical,
          1e-10);
      }
    EXPECT_EQ(effective_conductivity({{1., 0.}}, 2.), 0.);
  }

  TEST(EffectiveMedium, GeneralDimensionSolvesItsQuadratic)
  {
    // (n−1) Ke² + Ke [(1 − n f) K1 + (1 − n (1−f)) K2] − K1 K2 = 0.
    const double n = 2.7, f = .3, one = 1., two = 40.;
    const double b = (1 - n * f) * one + (1 - n * (1 - f)) * two;
    const double expected =
      (-b + std::sqrt(b * b + 4 * (n - 1) * one * two)) / (2 * (n - 1));
    EXPECT_NEAR(effective_conductivity({{f, one}, {1 - f, two}}, n) / expected,
                1.,
                rounding);
  }

  TEST(EffectiveMedium, ChannelInSeriesAndInParallel)
  {
    // n → 1 and n → ∞ are resistors in series and in parallel: the closed forms of
    // flow along and across a wavy gap.
    const double    ratio = .4;
    const SlabField gap =
      sample(make_layout({4096, 3, 1., 1.}, MPI_COMM_WORLD),
             [&](const double x, double) { return 1 + ratio * std::cos(2 * M_PI * x); });
    GapDistribution gaps = gap_histogram(gap, 1, 5000);
    EXPECT_EQ(gaps.contact_area, 0.);
    EXPECT_NEAR(effective_cubed_gap(gaps, 1 + 1e-9),
                std::pow(1 - ratio * ratio, 2.5) / (1 + .5 * ratio * ratio),
                1e-6);
    EXPECT_NEAR(effective_cubed_gap(gaps, 1e9), 1 + 1.5 * ratio * ratio, 2e-6);
  }

  TEST(EffectiveMedium, SlipClosesNarrowGaps)
  {
    // Contact on 0.1 of the area, and gaps of 0.1, 0.3 and 0.7 on 0.2, 0.3 and 0.4 of it.
    const SlabField gap =
      sample(make_layout({10, 3, 1., 1.}, MPI_COMM_WORLD), [](const double x, double) {
        return x < .05 ? 0. : x < .25 ? .1 : x < .55 ? .3 : .7;
      });
    const auto open = [&](const double slip_length) {
      return gap_histogram(gap, {0., .15, .5, 1.}, -2 * slip_length);
    };
    EXPECT_NEAR(open(0.).contact_area, .1, rounding);
    EXPECT_NEAR(open(-.05).contact_area, .3, rounding);
    EXPECT_EQ(effective_cubed_gap(open(-.15), 2.), 0.); // .6 is blocked
    EXPECT_NEAR(effective_cubed_gap(open(-.15), 4.),
                std::pow(.4, 3) * (1 - .6 * 4 / 3),
                rounding);
  }
} // namespace
