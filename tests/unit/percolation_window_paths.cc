// SPDX-License-Identifier: GPL-2.0-or-later
// Paths and throats on a grid with windows of finer points.
#include <strait/percolation/channel.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "window_tools.h"

namespace
{
  using namespace window_tests;

  TEST(WindowPath, ResistsLikeThatOfTheFineGrid)
  {
    // A channel with a neck in the windows. Outside the neck, the gap does not change
    // along the flow, so that both grids integrate it alike.
    for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
      for (const double centre : {.5, 0.})
        {
          const bool along_x = direction == FlowDirection::x;
          const auto neck    = [=](const double x, const double y) {
            const double s = (along_x ? x : y) - .5;
            const double t = std::remainder((along_x ? y : x) - centre, 1.);
            if (std::abs(t) > .1)
              return 0.;
            return 1. - .9 * std::max(1. - 36 * s * s, 0.) - t * t;
          };
          std::vector<ZoomWindow> windows = {window_at(9, centre == .5 ? 9 : 25, 14, 14),
                                             {0, 2, 15, 15, 12, 12}};
          if (!along_x)
            windows = transposed(windows);
          const SlabField zoomed    = sample(layout_with(32, windows), neck);
          const SlabField fine      = sample(layout_with(288, {}), neck);
          const Channel   channel   = make_channel(zoomed, 0., direction, 1);
          const Channel   reference = make_channel(fine, 0., direction, 1);
          ASSERT_EQ(channel.paths.size(), 1U);
          const FlowPath &path = channel.paths.front();
          EXPECT_EQ(path.bottleneck.window, 1);
          EXPECT_DOUBLE_EQ(path.bottleneck_gap, reference.paths.front().bottleneck_gap);
          // The outer window integrates with three times the spacing of the fine grid.
          EXPECT_NEAR(path.resistance() / reference.paths.front().resistance(), 1., 2e-3);
          const std::vector<ThroatOnPath> found = throats(channel, zoomed, 0.);
          ASSERT_EQ(found.size(), 1U);
          EXPECT_DOUBLE_EQ(found.front().fraction, 1.);
          EXPECT_TRUE(found.front().point == path.bottleneck);
          EXPECT_NEAR(found.front().points,
                      throats(reference, fine, 0.).front().points,
                      .02 * found.front().points);
        }
  }

  TEST(WindowPath, LeavesOtherThroatsToFurtherPaths)
  {
    // Two necks side by side, the wider one in a window: the second path must not squeeze
    // through the first neck beside the first path.
    const auto necks = [](const double x, const double y) {
      const double s = x - .5;
      for (const auto &[centre, gap] : {std::pair(.25, .3), {.75, .2}})
        if (const double t = y - centre; std::abs(t) < .04)
          return gap + 40 * s * s - t * t;
      return std::abs(s) > .2 ? 2. : 0.;
    };
    const SlabField gap   = sample(layout_with(64, {window_at(25, 9, 14, 14)}), necks);
    const auto      paths = make_channel(gap, 0., FlowDirection::x, 2).paths;
    ASSERT_EQ(paths.size(), 2U);
    EXPECT_EQ(paths[0].bottleneck.window, 0);
    EXPECT_EQ(paths[1].bottleneck.window, -1);
    EXPECT_NEAR(paths[0].bottleneck_gap, .3, 1e-12);
    EXPECT_NEAR(paths[1].bottleneck_gap, .2, 1e-12);
    const auto found = throats(make_channel(gap, 0., FlowDirection::x, 2), gap, 0.);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].point.window, 0);
    EXPECT_NEAR(found[0].points, 3 * std::sqrt(.3 / 40) * 64, .25);
    EXPECT_NEAR(found[1].points, std::sqrt(.2 / 40) * 64, .25);
  }

  TEST(WindowPath, FindsAThroatOnTheSeamAsLongAsItIs)
  {
    // The path enters through one neck on the seam and leaves through another one. The
    // other half of each neck leads nowhere: the channel is closed there.
    const auto gap_at = [](const double x, const double y) {
      const double s      = std::remainder(x, 1.);
      const double along  = .2 + 40 * s * s;
      const bool   enters = std::abs(y - .25) < .1 && s > -.1;
      const bool   leaves = std::abs(y - .75) < .1 && s < .1;
      const bool   joins  = std::abs(s) > .4;
      return joins ? 8. : enters && s < .45 ? along : leaves && s > -.45 ? along : 0.;
    };
    const SlabField gap     = sample(layout_with(64, {}), gap_at);
    const Channel   channel = make_channel(gap, 0., FlowDirection::x, 1);
    const auto      found   = throats(channel, gap, 0.);
    ASSERT_EQ(found.size(), 2U);
    for (const ThroatOnPath &throat : found)
      {
        EXPECT_EQ(throat.point.ix % 64, 0);
        EXPECT_NEAR(throat.points, std::sqrt(.2 / 40) * 64, .25);
      }
  }

  TEST(WindowThroat, IsMeasuredByItsOwnLevelAndBeyond)
  {
    // The gap near the edge of a contact, g ~ (t0 − t)^(3/2), turned by 30°, in a throat
    // so long that the gap doubles outside the windows.
    const double length = .14, width = .05, g0 = .01;
    const auto   gap = [=](double x, double y) {
      x -= .5;
      y -= .5;
      const double s = std::sqrt(.75) * x + .5 * y, t = -.5 * x + std::sqrt(.75) * y;
      return g0 * (1 + s * s / (length * length)) *
             std::pow(std::max(1 - t * t / (width * width), 0.), 1.5);
    };
    const SlabField field =
      sample(layout_with(64, {window_at(26, 26, 13, 13), {0, 2, 11, 11, 17, 17}}), gap);
    const Throat throat = measure_throat(field, 0., {25, 25, 1});
    EXPECT_DOUBLE_EQ(throat.gap, g0);
    EXPECT_NEAR(throat.doubling_length, length, 5e-3 * length);
    EXPECT_NEAR(throat.width, width / std::sqrt(1.5), 1e-3 * width);
    EXPECT_NEAR(throat.points, length * 64 * 9, .01 * throat.points);
    // The grid alone has few points across, but enough to measure the length.
    const Throat coarse = measure_throat(sample(layout_with(32, {}), gap), 0., {16, 16});
    EXPECT_NEAR(coarse.points, length * 32, .1 * coarse.points);
  }
} // namespace
