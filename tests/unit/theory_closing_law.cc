// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/theory/closing_law.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace strait;

  // Worked out by hand from the formulas, for the constant of a square saddle.
  TEST(ClosingLaw, ExponentsOfASquareSaddle)
  {
    struct Expected
    {
      double reduced_load, gap, width, leak_rate;
    };
    const ClosingLaw law;
    for (const Expected &expected : {Expected{1.4e-2, 1.206, .461, 3.476},
                                     Expected{7e-4, 1.174, .472, 3.406},
                                     Expected{1.4e-4, 1.162, .475, 3.380},
                                     Expected{1.4e-5, 1.150, .479, 3.353},
                                     Expected{1e-8, 1.124, .485, 3.296},
                                     Expected{1e-12, 1.106, .489, 3.255}})
      {
        const double load = expected.reduced_load;
        EXPECT_NEAR(law.at(load).gap, expected.gap, 1e-3) << load;
        EXPECT_NEAR(law.at(load).width, expected.width, 1e-3) << load;
        EXPECT_NEAR(law.at(load).length, .5 * expected.gap, 1e-3) << load;
        EXPECT_NEAR(law.at(load).leak_rate, expected.leak_rate, 1e-3) << load;
      }
    // The limits are approached so slowly that no contact gets there.
    EXPECT_NEAR(law.at(1e-300).leak_rate, 3., .08);
    EXPECT_GT(law.at(1e-300).leak_rate, 3.05);
  }

  TEST(ClosingLaw, SaysNothingWithoutAConstant)
  {
    const ClosingLaw unknown = ClosingLaw::fit({});
    EXPECT_TRUE(std::isnan(unknown.at(1e-3).leak_rate));
    EXPECT_TRUE(std::isnan(unknown.at(1e-3).width));
  }

  TEST(ClosingLaw, FitFindsTheConstantThatExponentsWereMadeWith)
  {
    for (const double constant : {-1., -.1, 0., .7, 5.})
      {
        const ClosingLaw               law{constant};
        std::vector<ClosingLaw::Slope> slopes;
        for (const double load : {.05, 1e-2, 1e-3, 1e-4})
          slopes.push_back({load, law.at(load).leak_rate});
        EXPECT_NEAR(ClosingLaw::fit(slopes).constant, constant, 1e-6);
        // One that is too large and one that is too small by as much.
        slopes.front().exponent += .01;
        slopes.back().exponent -= .01;
        EXPECT_NEAR(ClosingLaw::fit(slopes).constant, constant, 1e-6);
      }
  }

  TEST(ClosingLaw, FitSaysThatNoConstantWouldDo)
  {
    EXPECT_TRUE(std::isnan(ClosingLaw::fit({}).constant));
    EXPECT_TRUE(std::isnan(ClosingLaw::fit({{1e-2, 2.9}}).constant));
    EXPECT_TRUE(std::isnan(ClosingLaw::fit({{1e-2, 6.}}).constant));
  }

  /**
   * Volume per time and pressure difference through a slender throat alone, where the
   * fluid runs straight across the ridge: the gap is g0 (1 − y²/w²) + κ x²/2 with x along
   * the flow, so that ∫dx/g³ is known for each y, and
   *   12 η G = 8/(3π√2) √κ ∫ g(0, y)^{5/2} dy.
   * @p gap is g0, @p length that along the flow within which the gap doubles, so that
   * κ = 2 g0/length², @p width is w; @p viscosity η.
   */
  double
  throat_conductance(const double gap,
                     const double length,
                     const double width,
                     const double viscosity)
  {
    const double curvature = 2. * gap / (length * length);
    // ∫ (1 − t²)^{5/2} dt from −1 to 1
    const double profile = 5. * M_PI / 16.;
    return 8. / (3. * M_PI * std::sqrt(2.)) * std::sqrt(curvature) * std::pow(gap, 2.5) *
           width * profile / (12. * viscosity);
  }

  TEST(ClosingLaw, SaysNothingWhereTheConstrictionIsNoSmallPart)
  {
    EXPECT_TRUE(std::isnan(ClosingLaw{-1.3}.at(.3).leak_rate));
    EXPECT_FALSE(std::isnan(ClosingLaw{-1.3}.at(.05).leak_rate));
  }

  // Each filament of the flow runs straight across the ridge.
  TEST(ClosingLaw, ConductanceOfASlenderThroat)
  {
    const double gap = 3e-3, length = .02, width = .03, viscosity = .7;
    const auto   gap_at = [=](const double x, const double y) {
      return gap * (1. - y * y / (width * width) + x * x / (length * length));
    };
    const int n   = 400;
    double    sum = 0;
    for (int i = 0; i < n; ++i)
      {
        // The substitutions spread the points to where the integrands are.
        const double angle = M_PI * ((i + .5) / n - .5), y = width * std::sin(angle);
        const double scale      = length * std::cos(angle);
        double       resistance = 0;
        for (int j = 0; j < n; ++j)
          {
            const double t = M_PI * ((j + .5) / n - .5);
            resistance += scale / std::pow(std::cos(t), 2) /
                          std::pow(gap_at(scale * std::tan(t), y), 3) * M_PI / n;
          }
        sum += width * std::cos(angle) * M_PI / n / (12. * viscosity * resistance);
      }
    EXPECT_NEAR(throat_conductance(gap, length, width, viscosity) / sum, 1., 1e-6);
  }
} // namespace
