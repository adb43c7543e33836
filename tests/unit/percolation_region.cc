// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/channel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <vector>

namespace strait
{
  namespace
  {
    /** A rectangle with the inlet on its left and the outlet on its right side. */
    std::vector<OutlineEdge>
    rectangle(const double x0, const double y0, const double x1, const double y1)
    {
      return {{x0, y0, x1, y0, OutlineKind::right_wall},
              {x1, y0, x1, y1, OutlineKind::outlet},
              {x1, y1, x0, y1, OutlineKind::left_wall},
              {x0, y1, x0, y0, OutlineKind::inlet}};
    }

    FlowDomain
    domain_of(const PeriodicGrid &grid, const std::vector<OutlineEdge> &outline)
    {
      return {std::make_shared<const FlowRegion>(grid, outline, MPI_COMM_WORLD)};
    }

    SlabField
    sample(const PeriodicGrid &grid, const std::function<double(int, int)> &gap)
    {
      SlabField field(make_layout(grid, MPI_COMM_WORLD));
      for (int row = 0; row < field.layout().n_rows(); ++row)
        for (int ix = 0; ix < grid.nx; ++ix)
          field(ix, row) = gap(ix, field.layout().first_row() + row);
      return field;
    }

    const PeriodicGrid grid = {8, 8, 8., 8.};

    TEST(FlowRegion, PointsOnTheOutlineLieInside)
    {
      const FlowRegion region(grid, rectangle(2., 3., 5., 6.));
      const auto       k = [](const int x, const int y) { return y * 9 + x; };
      EXPECT_EQ(region.n_inside(), 16);
      for (int y = 0; y <= 8; ++y)
        for (int x = 0; x <= 8; ++x)
          EXPECT_EQ(region.is_inside(k(x, y)), x >= 2 && x <= 5 && y >= 3 && y <= 6);
      EXPECT_TRUE(region.is_inlet(k(2, 4)));
      EXPECT_TRUE(region.is_outlet(k(5, 6)));
      EXPECT_FALSE(region.is_inlet(k(3, 4)));
      EXPECT_TRUE(region.is_joined(k(2, 3), 1, 0));
      EXPECT_TRUE(region.is_joined(k(2, 4), 0, -1));
      EXPECT_FALSE(region.is_joined(k(2, 3), -1, 0));
      EXPECT_FALSE(region.is_joined(k(2, 3), 0, -1));
    }

    TEST(FlowRegion, BetweenGridLinesTheFluidEntersFromThePointBeyondTheInlet)
    {
      const FlowRegion region(grid, rectangle(1.6, 2.5, 5.3, 4.5));
      const auto       k = [](const int x, const int y) { return y * 9 + x; };
      EXPECT_EQ(region.n_inside(), 8);
      EXPECT_TRUE(region.is_inlet(k(1, 3)));
      EXPECT_FALSE(region.is_inside(k(1, 3)));
      EXPECT_TRUE(region.is_joined(k(1, 3), 1, 0));
      EXPECT_FALSE(region.is_joined(k(1, 3), 0, 1));
      EXPECT_TRUE(region.is_outlet(k(6, 4)));
      EXPECT_TRUE(region.is_joined(k(6, 4), -1, 0));
      EXPECT_FALSE(region.is_point(k(1, 5)));
      EXPECT_FALSE(region.is_joined(k(2, 3), 0, -1));
    }

    TEST(FlowRegion, AGridThatIsTooCoarseIsRefused)
    {
      EXPECT_THROW(FlowRegion(grid, rectangle(2.2, 2., 2.8, 5.)), InputError);
      EXPECT_THROW(FlowRegion(grid, rectangle(2., 2.2, 5., 2.4)), InputError);
    }

    TEST(FlowRegion, TheFluidDoesNotLeaveThroughWallsOrTheSeam)
    {
      // Open rows 0 and 7 are neighbours across the seam, but not in a region.
      const SlabField gap = sample(grid, [](const int x, const int y) {
        return (y == 0 && x < 5) || (y == 7 && x > 3) ? 1. : -1.;
      });
      const Clusters  clusters =
        find_clusters(gap, domain_of(grid, rectangle(0, 0, 8, 8)));
      EXPECT_FALSE(clusters.percolates);
      const SlabField wide =
        sample(grid, [](const int, const int y) { return y == 1 || y == 3 ? 1. : -1.; });
      // One of the two open rows lies outside the region.
      const Clusters half = find_clusters(wide, domain_of(grid, rectangle(0, 2, 8, 6)));
      EXPECT_TRUE(half.percolates);
      const long long n_percolating =
        std::count(half.states.begin(), half.states.end(), NodeState::percolating);
      EXPECT_EQ(sum(MPI_COMM_WORLD, n_percolating), 8);
      EXPECT_FALSE(
        find_clusters(wide, domain_of(grid, rectangle(0, 4, 8, 6))).percolates);
    }

    TEST(FlowRegion, VerdictPathAndBottleneckAgree)
    {
      // An S-shaped channel that narrows to `narrow` at (4, 5), through a region whose
      // outline lies between the grid lines.
      const FlowDomain domain = domain_of(grid, rectangle(.7, .7, 7.3, 7.3));
      for (const double narrow : {.25, -.25})
        {
          const SlabField  gap      = sample(grid, [=](const int x, const int y) {
            if (x == 4 && y == 5)
              return narrow;
            const bool open = (y == 2 && x <= 4) || (x == 4 && y > 2) ||
                              (y == 6 && x >= 4) || (y == 6 && x == 0);
            return open ? 1. : -1.;
          });
          const Clusters   clusters = find_clusters(gap, domain);
          const Bottleneck found    = find_bottleneck(gap, domain);
          EXPECT_EQ(clusters.percolates, narrow > 0);
          EXPECT_DOUBLE_EQ(found.value, narrow);
          EXPECT_EQ(found.point.ix, 4);
          EXPECT_EQ(found.point.iy, 5);
          const auto paths =
            find_flow_paths(percolating_gap(gap, clusters, domain), domain, 2);
          ASSERT_EQ(paths.size(), narrow > 0 ? 1U : 0U);
          if (narrow > 0)
            {
              EXPECT_EQ(paths[0].bottleneck.iy, 5);
              EXPECT_DOUBLE_EQ(paths[0].bottleneck_gap, narrow);
            }
        }
    }
  } // namespace
} // namespace strait
