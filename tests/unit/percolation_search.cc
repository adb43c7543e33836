// SPDX-License-Identifier: GPL-2.0-or-later
// Paths and bottlenecks, which are searched for block by block on all ranks, against
// textbook searches of the whole grid.
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/flow_path.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <random>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr int    n_along = 150, n_across = 90;

    /** A sum of waves of random phase, with values of both signs, the same on all ranks;
     *  point a along and b across the flow has the number b * n_along + a. */
    std::vector<double>
    rough_values(const unsigned int seed)
    {
      std::mt19937                           random(seed);
      std::uniform_real_distribution<double> phase(0., 2 * M_PI);
      std::vector<double>                    values(n_along * n_across, .6);
      for (int qa = 0; qa <= 12; ++qa)
        for (int qb = -8; qb <= 8; ++qb)
          {
            const double shift = phase(random), square = qa * qa + 2 * qb * qb;
            if (square == 0)
              continue;
            for (int b = 0; b < n_across; ++b)
              for (int a = 0; a < n_along; ++a)
                values[b * n_along + a] +=
                  1.7 / square *
                  std::cos(2 * M_PI *
                             (double(qa * a) / n_along + double(qb * b) / n_across) +
                           shift);
          }
      return values;
    }

    SlabField
    field_of(const std::vector<double> &values, const FlowDirection direction)
    {
      const bool         along_x = direction == FlowDirection::x;
      const PeriodicGrid grid    = along_x ? PeriodicGrid{n_along, n_across, 1.5, .9}
                                           : PeriodicGrid{n_across, n_along, .9, 1.5};
      const auto         layout  = make_layout(grid, MPI_COMM_WORLD);
      SlabField          field(layout);
      for (int row = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < grid.nx; ++ix)
          {
            const int iy = layout->first_row() + row;
            field(ix, row) =
              along_x ? values[iy * n_along + ix] : values[ix * n_along + iy];
          }
      return field;
    }

    double
    resistivity(const double g)
    {
      return 1. / (g * g * g);
    }

    /**
     * Return the least cost of a path through the whole grid, by Dijkstra's algorithm. A
     * path begins at (0, b) with start(b); total(cost, a, b, da, db) is its cost after a
     * step from (a, b) by (da, db).
     */
    double
    least_cost(const std::function<double(int)>                        &start,
               const std::function<double(double, int, int, int, int)> &total,
               const bool                                               diagonally)
    {
      using Entry               = std::pair<double, int>;
      const int           width = n_along + 1;
      std::vector<double> least(width * n_across, infinity);
      std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
      for (int b = 0; b < n_across; ++b)
        if (start(b) < infinity)
          {
            least[b * width] = start(b);
            queue.emplace(start(b), b * width);
          }
      while (!queue.empty())
        {
          const auto [here, k] = queue.top();
          queue.pop();
          if (here > least[k])
            continue;
          if (k % width == n_along)
            return here;
          for (int db = -1; db <= 1; ++db)
            for (int da = -1; da <= 1; ++da)
              {
                const int a = k % width + da, b = (k / width + db + n_across) % n_across;
                if (a < 0 || a > n_along || (!diagonally && da * db != 0))
                  continue;
                const double there = total(here, k % width, k / width, da, db);
                if (there < least[b * width + a])
                  {
                    least[b * width + a] = there;
                    queue.emplace(there, b * width + a);
                  }
              }
        }
      return infinity;
    }

    class Search : public ::testing::TestWithParam<unsigned int>
    {
    protected:
      const std::vector<double> values = rough_values(GetParam());

      double
      at(const int a, const int b) const
      {
        return values[(b + n_across) % n_across * n_along + a % n_along];
      }
    };

    TEST_P(Search, FindsTheLeastResistance)
    {
      const double expected =
        least_cost([this](const int b) { return at(0, b) > 0 ? 0. : infinity; },
                   [this](const double here, int a, int b, int da, int db) {
                     const double g = at(a, b), next = at(a + da, b + db);
                     if (!(next > 0))
                       return infinity;
                     const double mean = .5 * (resistivity(g) + resistivity(next));
                     if (da == 0 || db == 0)
                       return here + .01 * mean;
                     const double side_1 = at(a + da, b), side_2 = at(a, b + db);
                     if (!(side_1 > 0) && !(side_2 > 0))
                       return infinity;
                     const double middle =
                       .25 * (g + next + std::max(side_1, 0.) + std::max(side_2, 0.));
                     return here +
                            std::hypot(.01, .01) * std::max(mean, resistivity(middle));
                   },
                   true);
      for (const auto direction : {FlowDirection::x, FlowDirection::y})
        {
          const auto paths = find_flow_paths(field_of(values, direction), direction, 1);
          ASSERT_EQ(paths.size(), expected < infinity ? 1U : 0U);
          if (paths.empty())
            continue;
          const FlowPath &path = paths.front();
          EXPECT_NEAR(path.resistance() / expected, 1., 1e-12);
          EXPECT_EQ(path.resistances.front(), 0.);
          EXPECT_TRUE(std::is_sorted(path.resistances.begin(), path.resistances.end()));
          EXPECT_EQ(path.bottleneck_gap,
                    *std::min_element(path.gaps.begin(), path.gaps.end()));
          const bool along_x = direction == FlowDirection::x;
          EXPECT_EQ(along_x ? path.points.front().ix : path.points.front().iy, 0);
          EXPECT_EQ(along_x ? path.points.back().ix : path.points.back().iy, n_along);
          for (std::size_t k = 0; k < path.points.size(); ++k)
            {
              const auto [ix, iy, window] = path.points[k];
              EXPECT_EQ(path.gaps[k], along_x ? at(ix, iy) : at(iy, ix));
              if (k == 0)
                continue;
              const int dx = std::abs(ix - path.points[k - 1].ix);
              const int dy = std::abs(iy - path.points[k - 1].iy);
              EXPECT_LE(along_x ? dx : dy, 1);
              EXPECT_TRUE((along_x ? dy : dx) <= 1 ||
                          (along_x ? dy : dx) == n_across - 1);
            }
        }
    }

    TEST_P(Search, FindsTheWidestWay)
    {
      const double expected =
        -least_cost([this](const int b) { return -at(0, b); },
                    [this](const double here, int a, int b, int da, int db) {
                      return std::max(here, -at(a + da, b + db));
                    },
                    false);
      for (const auto direction : {FlowDirection::x, FlowDirection::y})
        {
          const Bottleneck found =
            find_bottleneck(field_of(values, direction), direction);
          EXPECT_EQ(found.value, expected);
          const bool along_x = direction == FlowDirection::x;
          EXPECT_EQ(along_x ? at(found.point.ix, found.point.iy)
                            : at(found.point.iy, found.point.ix),
                    expected);
          EXPECT_GE(found.reach, 1);
        }
    }

    INSTANTIATE_TEST_SUITE_P(Seeds, Search, ::testing::Range(1U, 9U));
  } // namespace
} // namespace strait
