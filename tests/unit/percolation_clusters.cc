// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/channel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace strait
{
  namespace
  {
    SlabField
    fill(const int nx, const int ny, const std::function<double(int, int)> &value)
    {
      SlabField field(make_layout({nx, ny, 1., 1.}, MPI_COMM_WORLD));
      for (int row = 0; row < field.layout().n_rows(); ++row)
        for (int ix = 0; ix < nx; ++ix)
          field(ix, row) = value(ix, field.layout().first_row() + row);
      return field;
    }

    /** '#' closed, anything else open with gap 1; the first string is row 0. */
    SlabField
    draw(const std::vector<std::string> &rows)
    {
      return fill(static_cast<int>(rows[0].size()),
                  static_cast<int>(rows.size()),
                  [&](const int ix, const int iy) {
                    return rows[iy][ix] == '#' ? 0. : 1.;
                  });
    }

    SlabField
    state_field(const SlabField &gap, const Clusters &clusters)
    {
      SlabField states(gap.layout_pointer());
      for (std::size_t k = 0; k < states.size(); ++k)
        states[k] = static_cast<double>(clusters.states[k]);
      return states;
    }

    /** The states as characters, row by row, on every rank. */
    std::vector<std::string>
    picture(const SlabField &gap, const Clusters &clusters)
    {
      std::vector<int> rows;
      for (int iy = 0; iy < gap.grid().ny; ++iy)
        rows.push_back(iy);
      const auto               values = fetch_rows(state_field(gap, clusters), rows);
      std::vector<std::string> result;
      for (int iy = 0; iy < gap.grid().ny; ++iy)
        {
          result.emplace_back();
          for (int ix = 0; ix < gap.grid().nx; ++ix)
            result.back() += "#.io*"[static_cast<int>(values[iy * gap.grid().nx + ix])];
        }
      return result;
    }

    /** Exchange rows and columns, so that a picture for flow along x is one for y. */
    std::vector<std::string>
    transposed(const std::vector<std::string> &rows)
    {
      std::vector<std::string> result(rows[0].size(), std::string(rows.size(), ' '));
      for (std::size_t y = 0; y < rows.size(); ++y)
        for (std::size_t x = 0; x < rows[0].size(); ++x)
          result[x][y] = rows[y][x];
      return result;
    }

    void
    expect_states(const std::vector<std::string> &gap,
                  const std::vector<std::string> &states)
    {
      const SlabField along_x = draw(gap), along_y = draw(transposed(gap));
      EXPECT_EQ(picture(along_x, find_clusters(along_x, FlowDirection::x)), states);
      EXPECT_EQ(picture(along_y, find_clusters(along_y, FlowDirection::y)),
                transposed(states));
    }

    TEST(Clusters, KnowsAllFiveStates)
    {
      expect_states({"   # ###", //
                     "#####   ",
                     "        ",
                     "########",
                     "  ## ## ",
                     "#### ###"},
                    {"iii#.###", //
                     "#####***",
                     "********",
                     "########",
                     "ii##.##o",
                     "####.###"});
    }

    TEST(Clusters, CornersDoNotConnect)
    {
      expect_states({"    ####", //
                     "####    "},
                    {"iiii####", //
                     "####...."});
    }

    TEST(Clusters, IsPeriodicAcrossTheFlowOnly)
    {
      expect_states({"    ####", //
                     "########",
                     "####### ",
                     "###     "},
                    {"iiii####", //
                     "########",
                     "#######i",
                     "###iiiii"});
      expect_states({"    ####", //
                     "########",
                     "        "},
                    {"****####", //
                     "########",
                     "********"});
    }

    TEST(Clusters, OutletNeedsAnOpenPointBehindTheSeam)
    {
      expect_states({"#       ", //
                     "########"},
                    {"#.......", //
                     "########"});
    }

    /** Mark the points that a plain flood fill by the same rule reaches from one side. */
    std::vector<int>
    flood(const std::vector<double> &gap, const int n, const bool from_inlet)
    {
      std::vector<int>         seen(gap.size(), 0);
      std::vector<std::size_t> stack;
      for (int y = 0; y < n; ++y)
        {
          const std::size_t k =
            static_cast<std::size_t>(y) * n + (from_inlet ? 0 : n - 1);
          if (gap[k] > 0 && (from_inlet || gap[static_cast<std::size_t>(y) * n] > 0))
            stack.push_back(k);
        }
      while (!stack.empty())
        {
          const std::size_t k = stack.back();
          stack.pop_back();
          if (seen[k] != 0 || !(gap[k] > 0))
            continue;
          seen[k]     = 1;
          const int x = static_cast<int>(k) % n, y = static_cast<int>(k) / n;
          if (x > 0)
            stack.push_back(k - 1);
          if (x < n - 1)
            stack.push_back(k + 1);
          stack.push_back(static_cast<std::size_t>((y + 1) % n) * n + x);
          stack.push_back(static_cast<std::size_t>((y + n - 1) % n) * n + x);
        }
      return seen;
    }

    TEST(Clusters, AgreeWithFloodFillOnRandomSites)
    {
      constexpr int n = 61;
      for (std::uint64_t seed = 1; seed <= 8; ++seed)
        {
          // Just above the site percolation threshold, 0.593, where clusters wind most.
          std::vector<double> whole(n * n);
          std::uint64_t       state = seed;
          for (double &value : whole)
            {
              state = state * 6364136223846793005ULL + 1442695040888963407ULL;
              value = static_cast<double>(state >> 11) * 0x1p-53 < .6 ? 1. : 0.;
            }
          const SlabField gap =
            fill(n, n, [&](const int ix, const int iy) { return whole[iy * n + ix]; });
          const auto inlet = flood(whole, n, true), outlet = flood(whole, n, false);
          const auto states = picture(gap, find_clusters(gap, FlowDirection::x));
          for (int k = 0; k < n * n; ++k)
            {
              const char expected = whole[k] == 0                     ? '#'
                                    : inlet[k] != 0 && outlet[k] != 0 ? '*'
                                    : inlet[k] != 0                   ? 'i'
                                    : outlet[k] != 0                  ? 'o'
                                                                      : '.';
              ASSERT_EQ(states[k / n][k % n], expected)
                << "seed " << seed << " point " << k;
            }
        }
    }

    TEST(Clusters, KeepsClosedValuesAndDropsPockets)
    {
      const SlabField gap      = fill(8, 8, [](const int ix, const int iy) {
        if (iy == 2)
          return 0.5;
        return ix == 4 && iy == 5 ? 1. : -0.25;
      });
      const Clusters  clusters = find_clusters(gap, FlowDirection::x);
      EXPECT_TRUE(clusters.percolates);
      const SlabField kept = percolating_gap(gap, clusters, FlowDirection::x);
      EXPECT_DOUBLE_EQ(mean(kept) * 64, 8 * .5 - 55 * .25);
    }

    TEST(Channel, LiesBetweenImmobileLayersOfFluid)
    {
      const SlabField gap     = fill(8, 8, [](const int ix, const int iy) {
        return iy == 2 ? (ix == 5 ? .5 : 1.) : ix == 3 && iy == 5 ? 2. : 0.;
      });
      const Channel   channel = make_channel(gap, -.2, FlowDirection::x, 1);
      ASSERT_TRUE(channel.percolates());
      ASSERT_EQ(channel.paths.size(), 1U);
      const FlowPath &path = channel.paths.front();
      EXPECT_EQ(path.bottleneck.ix, 5);
      EXPECT_NEAR(path.bottleneck_gap, .1, 1e-15);
      EXPECT_NEAR(channel.throat.gap, .1, 1e-15);
      EXPECT_DOUBLE_EQ(path.resistances.front(), 0.);
      // Gap 0.1 for half a spacing to each side of the bottleneck, 0.6 for 7 spacings.
      EXPECT_NEAR(path.resistance(), (1e3 + 7. / .216) / 8, 1e-9);
      EXPECT_NEAR(min_value(channel.gap), -.4, 1e-15);
      EXPECT_NEAR(max_value(channel.gap), .6, 1e-15); // trapped fluid is left out

      // No paths if none are asked for, and nothing at all where the layers meet.
      EXPECT_TRUE(make_channel(gap, -.2, FlowDirection::x, 0).paths.empty());
      const Channel sealed = make_channel(gap, -.25, FlowDirection::x, 1);
      EXPECT_FALSE(sealed.percolates());
      EXPECT_TRUE(sealed.gap.empty());
      EXPECT_TRUE(sealed.paths.empty());
    }

    TEST(FlowPath, TakesTheWiderSlitAndFindsItsBottleneck)
    {
      // Two straight slits: one of gap 0.2, and one of gap 1 with a neck of 0.5.
      const auto gap_at = [](const int ix, const int iy) {
        if (iy == 3)
          return .2;
        if (iy == 9)
          return ix == 11 ? .5 : 1.;
        return 0.;
      };
      const SlabField along_x = fill(16, 16, gap_at);
      const SlabField along_y =
        fill(16, 16, [&](const int ix, const int iy) { return gap_at(iy, ix); });
      const auto x = find_flow_paths(along_x, FlowDirection::x, 3);
      const auto y = find_flow_paths(along_y, FlowDirection::y, 3);
      ASSERT_EQ(x.size(), 2U);
      ASSERT_EQ(y.size(), 2U);
      EXPECT_EQ(x[0].points.size(), 17U);
      EXPECT_EQ(x[0].bottleneck.ix, 11);
      EXPECT_EQ(x[0].bottleneck.iy, 9);
      EXPECT_DOUBLE_EQ(x[0].bottleneck_gap, .5);
      // 14 steps at gap 1, and two with one end in the neck.
      EXPECT_NEAR(x[0].resistance(), (14 * 1. + 2 * (.5 * 8 + .5)) / 16, 1e-12);
      EXPECT_NEAR(x[1].resistance(), 125., 1e-9);
      EXPECT_EQ(y[0].bottleneck.iy, 11);
      EXPECT_DOUBLE_EQ(y[0].resistance(), x[0].resistance());
    }

    TEST(FlowPath, TakesAnotherChannelNotAnotherWayThroughTheSameThroat)
    {
      // Two channels, 13 points wide, with 0.5 and 0.2 of their usual gap at a throat.
      const SlabField gap   = fill(32, 32, [](const int ix, const int iy) {
        const double from_wall = std::min(iy % 16 - 1, 15 - iy % 16);
        const double throat    = ix == 16 ? (iy < 16 ? .5 : .2) : 1.;
        return std::max(throat * from_wall, 0.);
      });
      const auto      paths = find_flow_paths(gap, FlowDirection::x, 6);
      ASSERT_EQ(paths.size(), 2U);
      EXPECT_LT(paths[0].bottleneck.iy, 16);
      EXPECT_GT(paths[1].bottleneck.iy, 16);
      // A channel with more than 500 times the resistance of the first is left out.
      const SlabField uneven = fill(32, 32, [](const int ix, const int iy) {
        const double from_wall = std::min(iy % 16 - 1, 15 - iy % 16);
        const double throat    = ix == 16 ? (iy < 16 ? .5 : .02) : 1.;
        return std::max(throat * from_wall, 0.);
      });
      EXPECT_EQ(find_flow_paths(uneven, FlowDirection::x, 6).size(), 1U);
    }

    TEST(FlowPath, CrossesThePeriodicSideButNoTouchingCorners)
    {
      // The only path leads from row 0 across the periodic side to row 7.
      const SlabField gap = fill(8, 8, [](const int ix, const int iy) {
        return (iy == 0 && ix <= 4) || (iy == 7 && (ix >= 4 || ix == 0)) ? 1. : 0.;
      });
      ASSERT_TRUE(find_clusters(gap, FlowDirection::x).percolates);
      const auto paths = find_flow_paths(gap, FlowDirection::x, 1);
      ASSERT_EQ(paths.size(), 1U);
      EXPECT_EQ(paths[0].points.back().ix, 8);

      const SlabField corners = fill(8, 8, [](const int ix, const int iy) {
        return (iy == 2 && ix < 4) || (iy == 3 && ix >= 4) ? 1. : 0.;
      });
      EXPECT_FALSE(find_clusters(corners, FlowDirection::x).percolates);
      EXPECT_TRUE(find_flow_paths(corners, FlowDirection::x, 1).empty());
    }
  } // namespace
} // namespace strait
