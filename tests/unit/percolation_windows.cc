// SPDX-License-Identifier: GPL-2.0-or-later
// Clusters and bottlenecks on a grid with windows of finer points.
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/channel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "window_tools.h"

namespace
{
  using namespace window_tests;

  /**
   * The clusters of a grid with windows, computed independently: a graph of the places of
   * open points on all levels, flooded from inlet and outlet.
   */
  class PlainGraph
  {
  public:
    using Place = std::pair<int, int>;

    PlainGraph(const SlabField &gap, const FlowDirection direction)
      : layout(gap.layout())
      , n(layout.grid().nx)
    {
      std::vector<int> all;
      for (int row = 0; row < n; ++row)
        all.push_back(row);
      const std::vector<double> grid = fetch_rows(gap, all);
      add_level(-1, n, n, [&](const int ix, const int iy) {
        return grid[static_cast<std::size_t>(iy) * n + ix] > 0;
      });
      for (int w = 0; w < static_cast<int>(layout.windows().size()); ++w)
        {
          const int n_columns = layout.windows()[w].n_columns();
          add_level(w,
                    n_columns,
                    layout.windows()[w].n_rows(),
                    [&](const int ix, const int iy) {
                      return gap[layout.start_of_window(w) +
                                 static_cast<std::size_t>(iy) * n_columns + ix] > 0;
                    });
        }
      // The grid is periodic across the flow only.
      for (int k = 0; k < n; ++k)
        if (direction == FlowDirection::x)
          add_edge(-1, {k, n - 1}, {k, 0});
        else
          add_edge(-1, {n - 1, k}, {0, k});
      for (int k = 0; k < n; ++k)
        {
          const bool  along_x = direction == FlowDirection::x;
          const Place first   = along_x ? Place(0, k) : Place(k, 0);
          const Place last    = along_x ? Place(n - 1, k) : Place(k, n - 1);
          const Place inlet   = place_of(layout, -1, first.first, first.second);
          const Place outlet  = place_of(layout, -1, last.first, last.second);
          flood(inlet, from_inlet);
          if (open.count(inlet) > 0)
            flood(outlet, from_outlet);
        }
    }

    NodeState
    state(const Place &place) const
    {
      const bool in = from_inlet.count(place) > 0, out = from_outlet.count(place) > 0;
      return open.count(place) == 0 ? NodeState::closed
             : in && out            ? NodeState::percolating
             : in                   ? NodeState::inlet_side
             : out                  ? NodeState::outlet_side
                                    : NodeState::trapped;
    }

  private:
    void
    add_level(const int                            w,
              const int                            n_columns,
              const int                            n_rows,
              const std::function<bool(int, int)> &is_open)
    {
      const int rim = w < 0 ? 0 : 1;
      for (int iy = rim; iy < n_rows - rim; ++iy)
        for (int ix = rim; ix < n_columns - rim; ++ix)
          if (is_open(ix, iy))
            open[place_of(layout, w, ix, iy)] = true;
      for (int iy = rim; iy < n_rows - rim; ++iy)
        for (int ix = rim; ix < n_columns - rim; ++ix)
          {
            if (ix + 1 < n_columns - rim)
              add_edge(w, {ix, iy}, {ix + 1, iy});
            if (iy + 1 < n_rows - rim)
              add_edge(w, {ix, iy}, {ix, iy + 1});
          }
    }

    void
    add_edge(const int w, const Place &a, const Place &b)
    {
      const auto finer_a = layout.finer({a.first, a.second, w});
      const auto finer_b = layout.finer({b.first, b.second, w});
      if (finer_a && finer_b && finer_a->window == finer_b->window)
        return;
      const Place from = place_of(layout, w, a.first, a.second);
      const Place to   = place_of(layout, w, b.first, b.second);
      edges[from].push_back(to);
      edges[to].push_back(from);
    }

    void
    flood(const Place &start, std::map<Place, bool> &reached)
    {
      std::vector<Place> stack = {start};
      while (!stack.empty())
        {
          const Place here = stack.back();
          stack.pop_back();
          if (open.count(here) == 0 || reached.count(here) > 0)
            continue;
          reached[here] = true;
          for (const Place &next : edges[here])
            stack.push_back(next);
        }
    }

    const SlabLayout                   &layout;
    int                                 n;
    std::map<Place, bool>               open, from_inlet, from_outlet;
    std::map<Place, std::vector<Place>> edges;
  };

  /** Two windows, of which the first crosses the periodic sides and contains a third one;
   *  transposed for flow along y. */
  std::vector<ZoomWindow>
  windows_for(const FlowDirection direction)
  {
    const std::vector<ZoomWindow> windows = {window_at(3, 20, 7, 9),
                                             window_at(13, 4, 8, 6),
                                             {0, 2, 5, 6, 8, 9}};
    return direction == FlowDirection::x ? windows : transposed(windows);
  }

  TEST(WindowClusters, FollowTheRuleOnNoise)
  {
    int n_leaking = 0;
    for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
      for (std::uint64_t seed = 1; seed <= 8; ++seed)
        {
          const SlabLayoutPtr layout = layout_with(24, windows_for(direction));
          SlabField           gap    = noise_field(layout, seed);
          for (double &value : gap)
            value -= .38;
          const Clusters   clusters = find_clusters(gap, direction);
          const PlainGraph graph(gap, direction);
          ASSERT_EQ(clusters.states.size(), gap.size());
          for (int row = 0; row < layout->n_rows(); ++row)
            for (int ix = 0; ix < 24; ++ix)
              ASSERT_EQ(clusters.states[static_cast<std::size_t>(row) * 24 + ix],
                        graph.state(
                          place_of(*layout, -1, ix, layout->first_row() + row)));
          for (int w = 0; w < 3; ++w)
            {
              const ZoomWindow &window = layout->windows()[w];
              for (int iy = 1; iy < window.n_rows() - 1; ++iy)
                for (int ix = 1; ix < window.n_columns() - 1; ++ix)
                  ASSERT_EQ(
                    clusters
                      .states[layout->start_of_window(w) +
                              static_cast<std::size_t>(iy) * window.n_columns() + ix],
                    graph.state(place_of(*layout, w, ix, iy)))
                    << w << ' ' << ix << ' ' << iy;
            }
          n_leaking += clusters.percolates ? 1 : 0;
        }
    // An open fraction of 0.62 is close to the site percolation threshold, 0.593.
    EXPECT_GT(n_leaking, 2);
    EXPECT_LT(n_leaking, 14);
  }

  /** Expect that each step of a path is one spacing of a level, straight or diagonal. */
  void
  expect_small_steps(const FlowPath &path, const SlabLayout &layout)
  {
    const int  n     = 9 * layout.grid().nx;
    const auto place = [&](const std::size_t k) {
      const GridPoint &p = path.points[k];
      return place_of(layout, p.window, p.ix, p.iy);
    };
    const auto distance = [n](const int a, const int b) {
      return std::min((a - b + n) % n, (b - a + n) % n);
    };
    for (std::size_t k = 1; k < path.points.size(); ++k)
      {
        const int dx = distance(place(k).first, place(k - 1).first);
        const int dy = distance(place(k).second, place(k - 1).second);
        EXPECT_TRUE(dx == dy || dx == 0 || dy == 0) << dx << ' ' << dy;
        const int d = std::max(dx, dy);
        EXPECT_TRUE(d == 1 || d == 3 || d == 9) << d;
        EXPECT_GT(path.gaps[k], 0.);
        EXPECT_GE(path.resistances[k], path.resistances[k - 1]);
      }
  }

  TEST(WindowBottleneck, IsWhereClustersBegin)
  {
    for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
      for (std::uint64_t seed = 1; seed <= 8; ++seed)
        {
          const SlabLayoutPtr layout = layout_with(24, windows_for(direction));
          const SlabField     gap    = noise_field(layout, seed);
          const Bottleneck    found  = find_bottleneck(gap, direction);
          for (const bool above : {false, true})
            {
              SlabField less = gap;
              for (double &value : less)
                value -= found.value * (above ? 1. : 1. - 1e-12);
              EXPECT_EQ(find_clusters(less, direction).percolates, !above);
              // There is a path exactly where clusters percolate.
              const Channel channel = make_channel(less, 0., direction, 1);
              ASSERT_EQ(channel.paths.size(), above ? 0U : 1U);
              if (!above)
                expect_small_steps(channel.paths.front(), *layout);
            }
        }
  }

  TEST(WindowClusters, SeeASlitBetweenTheRows)
  {
    // A wall with a slit of half a spacing that lies between two rows of the grid.
    const auto slit = [](const double x, const double y) {
      return std::abs(x - .5) > .1 || std::abs(y - 15.5 / 32) < .25 / 32 ? 1. : -1.;
    };
    const SlabField coarse = sample(layout_with(32, {}), slit);
    const SlabField zoomed = sample(layout_with(32, {window_at(10, 10, 12, 12)}), slit);
    EXPECT_FALSE(find_clusters(coarse, FlowDirection::x).percolates);
    EXPECT_TRUE(find_clusters(zoomed, FlowDirection::x).percolates);
    EXPECT_LT(find_bottleneck(coarse, FlowDirection::x).value, 0.);
    EXPECT_GT(find_bottleneck(zoomed, FlowDirection::x).value, 0.);

    // A thin wall between two columns, in a channel that the window spans.
    const auto wall = [](const double x, const double y) {
      return std::abs(y - .5) > .1 || std::abs(x - 15.5 / 32) < .25 / 32 ? -1. : 1.;
    };
    EXPECT_TRUE(
      find_clusters(sample(layout_with(32, {}), wall), FlowDirection::x).percolates);
    EXPECT_FALSE(find_clusters(sample(layout_with(32, {window_at(10, 10, 12, 12)}), wall),
                               FlowDirection::x)
                   .percolates);
  }

  TEST(WindowGap, KeepsPercolatingPointsOnAllLevels)
  {
    const auto height = [](const double x, const double y) {
      if (std::abs(y - .5) < .1)
        return 1.;
      return std::hypot(x - .5, y - .35) < .025 ? .5 : -3.; // a pocket in the window
    };
    const SlabField gap      = sample(layout_with(32, {window_at(9, 7, 14, 14)}), height);
    const Clusters  clusters = find_clusters(gap, FlowDirection::x);
    const SlabField kept     = percolating_gap(gap, clusters, FlowDirection::x);
    int             n_pocket = 0;
    for (std::size_t k = 0; k < gap.size(); ++k)
      if (gap[k] == 1.)
        EXPECT_EQ(kept[k], 1.);
      else if (gap[k] > 0)
        {
          ++n_pocket;
          EXPECT_EQ(kept[k], 0.);
        }
      else
        EXPECT_TRUE(kept[k] == -3. || kept[k] == -1.);
    EXPECT_GT(n_pocket, 9);
    // Beside the channel, the closed points of each level are raised; grid points that
    // the window covers take its values.
    const SlabLayout &layout = gap.layout();
    layout.for_each_covered([&](const std::size_t k, const std::size_t in_window) {
      EXPECT_EQ(kept[k], kept[in_window]);
    });
    const auto in_window = [&](const int ix, const int iy) {
      return kept[layout.start_of_window(0) + static_cast<std::size_t>(iy) * 42 + ix];
    };
    // The first open row is 13 (12.8) of the grid, 39 (38.4) in thirds, 19 of the window.
    EXPECT_EQ(in_window(20, 19), 1.);
    EXPECT_EQ(in_window(20, 18), -1.);
    EXPECT_EQ(in_window(20, 17), -3.);
  }

  TEST(WindowBottleneck, IsThatOfTheFineGrid)
  {
    // Windows of two levels around the bottleneck against a grid as fine as the second
    // level. For these seeds, the bottleneck is not at the inlet or outlet.
    constexpr int n = 48;
    for (const std::uint64_t seed : {1U, 4U, 6U, 8U})
      {
        const SlabField  fine     = sample(layout_with(9 * n, {}), rough(seed));
        const Bottleneck expected = find_bottleneck(fine, FlowDirection::x);
        const int        x = expected.point.ix / 9, y = expected.point.iy / 9;
        const int        half = 9;
        ZoomWindow outer    = window_at(x - half, (y - half + n) % n, 2 * half, 2 * half);
        outer.x             = std::clamp(outer.x, 1, n - 2 * half);
        const int        at = 3 * (x - outer.x) + 1 - 9;
        const ZoomWindow inner = {
          0, 2, std::clamp(at, 4, 6 * half - 18 - 4), 3 * half - 8, 18, 18};
        const SlabField  zoomed = sample(layout_with(n, {outer, inner}), rough(seed));
        const Bottleneck found  = find_bottleneck(zoomed, FlowDirection::x);
        const Bottleneck grid =
          find_bottleneck(sample(layout_with(n, {}), rough(seed)), FlowDirection::x);
        EXPECT_NEAR(found.value, expected.value, 1e-12)
          << seed << " at " << x << " " << y;
        EXPECT_GT(std::abs(grid.value - expected.value), 1e-5) << seed;
        EXPECT_EQ(found.point.window, 1) << seed;
        const auto [px, py] =
          zoomed.layout().position(found.point.window, found.point.ix, found.point.iy);
        EXPECT_NEAR(px, expected.point.ix / (9. * n), 1e-9) << seed;
        EXPECT_NEAR(std::remainder(py - expected.point.iy / (9. * n), 1.), 0., 1e-9);
      }
  }
} // namespace
