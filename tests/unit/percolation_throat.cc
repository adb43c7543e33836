// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/channel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace strait
{
  namespace
  {
    SlabField
    sample(const int n, const std::function<double(double, double)> &value)
    {
      SlabField field(make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
      for (int row = 0; row < field.layout().n_rows(); ++row)
        for (int ix = 0; ix < n; ++ix)
          field(ix, row) =
            value(static_cast<double>(ix) / n,
                  static_cast<double>(field.layout().first_row() + row) / n);
      return field;
    }

    TEST(Throat, OfATurnedSaddleAtTheCorner)
    {
      // Turned by 30°, at the corner of the box, where rows and columns wrap around.
      const double length = .3, width = .2, g0 = .01;
      const auto   gap = [=](double x, double y) {
        x -= std::round(x);
        y -= std::round(y);
        const double s = std::sqrt(.75) * x + .5 * y, t = -.5 * x + std::sqrt(.75) * y;
        return g0 * (1 + s * s / (length * length)) * (1 - t * t / (width * width));
      };
      const Throat throat = measure_throat(sample(256, gap), 0., {0, 0});
      EXPECT_DOUBLE_EQ(throat.gap, g0);
      EXPECT_NEAR(throat.length, length, 1e-3);
      EXPECT_NEAR(throat.width, width, 1e-3);
      EXPECT_NEAR(throat.points_across,
                  2. * width * 256. / std::hypot(.5, std::sqrt(.75)),
                  .1);
      const Throat valley =
        measure_throat(sample(64, [](double, const double y) { return 1 + y * (1 - y); }),
                       0.,
                       {5, 32});
      EXPECT_TRUE(std::isnan(valley.length));
      // In a crease, the second difference grows as the spacing shrinks, and the width
      // that follows from it is √(width · spacing).
      for (const int n : {64, 256})
        {
          const Throat crease =
            measure_throat(sample(n,
                                  [=](const double x, const double y) {
                                    return g0 * (1 + std::pow((x - .5) / length, 2)) *
                                           (1 - std::abs(y - .5) / width);
                                  }),
                           0.,
                           {n / 2, n / 2});
          EXPECT_NEAR(crease.points_across, 2. * std::sqrt(width * n), .01);
        }
    }

    // When only the spacing along the throat counted, the critical load on a box of
    // 128 × 32 points was 6 % off where 0.3 % was stated.
    TEST(Throat, PointsAreCountedByTheLargerSpacing)
    {
      const double length = .3, width = .2, g0 = .01;
      const auto   points_along = [=](const int nx, const int ny, const bool along_x) {
        SlabField field(make_layout({nx, ny, 1., 1.}, MPI_COMM_WORLD));
        for (int row = 0; row < field.layout().n_rows(); ++row)
          for (int ix = 0; ix < nx; ++ix)
            {
              const double x = static_cast<double>(ix) / nx - .5;
              const double y =
                static_cast<double>(field.layout().first_row() + row) / ny - .5;
              const double s = along_x ? x : y, t = along_x ? y : x;
              field(ix, row) =
                g0 * (1 + s * s / (length * length)) * (1 - t * t / (width * width));
            }
        const Throat throat = measure_throat(field, 0., {nx / 2, ny / 2});
        EXPECT_NEAR(throat.points_across / (2. * width * std::min(nx, ny)), 1., .01);
        return throat.points;
      };
      for (const bool along_x : {true, false})
        {
          EXPECT_NEAR(points_along(128, 64, along_x) / (64 * length), 1., .01);
          EXPECT_NEAR(points_along(128, 128, along_x) / (128 * length), 1., .01);
        }
    }

    TEST(FlowPath, TheThroatIsTheLastOfTheNarrowestPoints)
    {
      FlowPath path;
      path.gaps        = {1., 2., 3., 2., 1.};
      path.resistances = {0., 1., 1.2, 1.4, 2.4};
      EXPECT_DOUBLE_EQ(path.part_before_throat(), .5 * (1.4 + 2.4) / 2.4);
    }

    TEST(Constrictions, AreDividedWhereTheChannelWidens)
    {
      const std::vector<double> gaps  = {3, 1, 1.2, 1.1, 5, 2, 2.9, 2.1, 4};
      const auto                parts = divide_into_constrictions(gaps);
      ASSERT_EQ(parts.size(), 2U);
      EXPECT_EQ(parts[0].first, 0U);
      EXPECT_EQ(parts[0].last, 4U);
      EXPECT_EQ(parts[1].last, 8U);
      EXPECT_EQ(parts[0].narrowest, 1U);
      EXPECT_EQ(parts[1].narrowest, 5U);
      EXPECT_EQ(divide_into_constrictions({1, 1, 1}).size(), 1U);
      EXPECT_EQ(divide_into_constrictions({4, 3, 2, 1}).size(), 1U);
    }

    TEST(Bottleneck, OfTheWidestWayOnBothSidesOfClosing)
    {
      // Two paths across the box: one with a neck of 0.3, one closed by a neck of −0.2.
      const auto field = [](const double shift) {
        return sample(32, [=](const double x, const double y) {
          if (std::abs(y - .25) < .02)
            return (std::abs(x - .5) < .02 ? .3 : 1.) + shift;
          if (std::abs(y - .75) < .02)
            return (std::abs(x - .25) < .02 ? -.2 : 1.) + shift;
          return -1. + shift;
        });
      };
      for (const double shift : {0., -.4})
        {
          const Bottleneck found = find_bottleneck(field(shift), FlowDirection::x);
          EXPECT_DOUBLE_EQ(found.value, .3 + shift);
          EXPECT_EQ(found.point.ix, 16);
          EXPECT_EQ(found.point.iy, 8);
        }
      EXPECT_DOUBLE_EQ(find_bottleneck(field(0.), FlowDirection::y).value, -1.);
    }

    TEST(Bottleneck, ReachesToTheEndOfABarrier)
    {
      // A barrier across the flow, 2 n − 1 points thick, firmest in its middle.
      for (const int n : {1, 4})
        {
          const Bottleneck found =
            find_bottleneck(sample(32,
                                   [n](const double x, double) {
                                     const double d = std::abs(x - .5) * 32 - n + .5;
                                     return d < 0 ? d : 1.;
                                   }),
                            FlowDirection::x);
          EXPECT_EQ(found.point.ix, 16);
          EXPECT_EQ(found.reach, n);
        }
    }
  } // namespace
} // namespace strait
