// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/fixed_point.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace strait
{
  namespace
  {
    /** An affine map of three values with the fixed point (1, −2, 3). */
    std::vector<double>
    affine(const std::vector<double> &x)
    {
      const double a = x[0] - 1, b = x[1] + 2, c = x[2] - 3;
      return {1 + .9 * a + .3 * b, -2 - .3 * a + .8 * b, 3 - 1.5 * c};
    }

    double
    plain_product(const std::vector<float> &a, const std::vector<float> &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }

    double
    error(const std::vector<double> &x)
    {
      return std::hypot(x[0] - 1, x[1] + 2, x[2] - 3);
    }

    TEST(FixedPoint, SolvesAnAffineMapInAsManyRoundsAsItHasDimensions)
    {
      FixedPoint          iteration(plain_product, 4, 1.);
      std::vector<double> x = {0, 0, 0};
      for (int round = 0; round < 6; ++round)
        iteration.advance(x.data(), affine(x).data(), x.size());
      EXPECT_LT(error(x), 1e-4); // the map alone diverges
    }

    TEST(FixedPoint, RelaxesWithoutHistory)
    {
      FixedPoint          iteration(plain_product, 0, .25);
      std::vector<double> x = {1, -2, 4}, image = affine(x);
      iteration.advance(x.data(), image.data(), x.size());
      EXPECT_DOUBLE_EQ(x[2], .75 * 4 + .25 * image[2]);
    }

    TEST(FixedPoint, RelaxesLessWhereTheResidualTurnsRound)
    {
      // Plain rounds of this map, x → −3 x, diverge.
      FixedPoint          iteration(plain_product, 4, 1.);
      std::vector<double> x = {1.};
      for (int round = 0; round < 30; ++round)
        {
          const double image = -3. * x[0];
          iteration.advance(x.data(), &image, 1, false);
        }
      EXPECT_LT(std::abs(x[0]), 1e-3);
    }

    TEST(FixedPoint, ComesToAJump)
    {
      // Each image lies beyond the jump of the map at 0.5: steps must shrink towards it.
      FixedPoint          iteration(plain_product, 4, 1.);
      std::vector<double> x = {.8};
      for (int round = 0; round < 60; ++round)
        {
          const double image = x[0] < .5 ? .9 : .2;
          iteration.advance(x.data(), &image, 1, false);
        }
      EXPECT_NEAR(x[0], .5, 1e-3);
    }

    TEST(FixedPoint, ForgetsOnRestart)
    {
      FixedPoint          iteration(plain_product, 4, 1.);
      std::vector<double> x = {0, 0, 0};
      for (int round = 0; round < 3; ++round)
        iteration.advance(x.data(), affine(x).data(), x.size());
      iteration.restart();
      x                               = {5, 5, 5};
      const std::vector<double> image = affine(x);
      iteration.advance(x.data(), image.data(), x.size());
      EXPECT_EQ(x, image);
    }

    TEST(FixedPoint, KeepsItsDirectionsWhenItMovesOn)
    {
      // The same map with its fixed point moved: the directions found so far still hold.
      FixedPoint          iteration(plain_product, 4, 1.);
      std::vector<double> x = {0, 0, 0};
      for (int round = 0; round < 5; ++round)
        iteration.advance(x.data(), affine(x).data(), x.size());
      iteration.move_on();
      std::vector<double> y = {1, 1, 1};
      for (int round = 0; round < 2; ++round)
        {
          std::vector<double> image = affine({y[0] + .1, y[1] - .1, y[2] + .2});
          image                     = {image[0] - .1, image[1] + .1, image[2] - .2};
          iteration.advance(y.data(), image.data(), y.size());
        }
      EXPECT_LT(error({y[0] + .1, y[1] - .1, y[2] + .2}), 1e-3);
    }

    TEST(FixedPoint, ToleratesParallelDifferences)
    {
      FixedPoint          iteration(plain_product, 4, 1.);
      std::vector<double> x = {0, 0, 0};
      for (int round = 0; round < 12; ++round)
        iteration.advance(x.data(), affine(x).data(), x.size());
      EXPECT_LT(error(x), 1e-5);
    }
  } // namespace
} // namespace strait
