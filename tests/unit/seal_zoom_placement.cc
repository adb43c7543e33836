// SPDX-License-Identifier: GPL-2.0-or-later
// Where windows lie around throats that are placed by hand.
#include <strait/seal/zoom_placement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
  using namespace strait;

  using Windows = std::vector<ZoomWindow>;

  const ZoomParameters zoom; // 12 points along a throat

  SlabLayoutPtr
  box_with(const Windows &windows = {}, const int n = 256)
  {
    return with_windows(*make_layout({n, n, 1., 1.}, MPI_COMM_WORLD), windows);
  }

  ThroatOnPath
  throat(const int    ix,
         const int    iy,
         const int    window   = -1,
         const double points   = 3.,
         const double fraction = .5)
  {
    return {{ix, iy, window}, fraction, points};
  }

  Windows
  placed(const std::vector<ThroatOnPath> &throats, const Windows &windows = {})
  {
    return place_windows(*box_with(windows), throats, zoom);
  }

  /** Whether the window covers a point of the parent, of the box's @p n or none. */
  bool
  covers(const ZoomWindow &window, const int ix, const int iy, const int n = 256)
  {
    const auto inside = [&](const int i, const int first, const int size) {
      return window.parent < 0 ? ((i - first) % n + n) % n < size
                               : i >= first && i < first + size;
    };
    return inside(ix, window.x, window.nx) && inside(iy, window.y, window.ny);
  }

  /** What the type promises: children within their parents, siblings apart. */
  void
  expect_sound(const Windows &windows)
  {
    for (std::size_t w = 0; w < windows.size(); ++w)
      {
        const ZoomWindow &window = windows[w];
        if (window.parent >= 0)
          {
            ASSERT_LT(window.parent, static_cast<int>(w));
            const ZoomWindow &parent = windows[window.parent];
            const int         margin = ZoomWindow::margin;
            EXPECT_EQ(window.level, parent.level + 1);
            EXPECT_GE(window.x, margin);
            EXPECT_GE(window.y, margin);
            EXPECT_LE(window.x + window.nx, parent.n_columns() - margin);
            EXPECT_LE(window.y + window.ny, parent.n_rows() - margin);
          }
        else
          {
            EXPECT_EQ(window.level, 1);
          }
        // Around another one, and the points between them, there is nothing of this.
        for (std::size_t other = 0; other < w; ++other)
          for (int y = -1; y <= window.ny; ++y)
            for (int x = -1; x <= window.nx; ++x)
              ASSERT_FALSE(windows[other].parent == window.parent &&
                           covers(windows[other], window.x + x, window.y + y))
                << other << " and " << w;
      }
  }

  TEST(ZoomPlacement, OpensAWindowAroundAThroat)
  {
    const Windows windows = placed({throat(100, 60)});
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_TRUE(windows[0] == (ZoomWindow{-1, 1, 76, 36, 48, 48}));
  }

  TEST(ZoomPlacement, OpensNoneWhereNothingIsLacking)
  {
    EXPECT_TRUE(placed({throat(100, 60, -1, 12.)}).empty());
    // What less of the pressure drops at needs fewer: half of them for a quarter.
    EXPECT_TRUE(placed({throat(100, 60, -1, 6.1, .25)}).empty());
    EXPECT_EQ(placed({throat(100, 60, -1, 5.9, .25)}).size(), 1U);
    // Those that are there stay.
    const Windows some = {{-1, 1, 60, 20, 80, 80}};
    EXPECT_TRUE(placed({throat(100, 150, -1, 12.)}, some) == some);
    EXPECT_TRUE(placed({}, some) == some);
    ZoomParameters one_level = zoom;
    one_level.maximum_levels = 1;
    EXPECT_TRUE(place_windows(*box_with(some), {throat(120, 120, 0)}, one_level) == some);
  }

  TEST(ZoomPlacement, CrossesTheSeams)
  {
    const Windows windows = placed({throat(2, 250)});
    ASSERT_EQ(windows.size(), 1U);
    const SlabLayoutPtr layout = box_with(windows);
    const ZoomWindow   &window = windows[0];
    EXPECT_TRUE(covers(window, 2, 250));
    EXPECT_TRUE(covers(window, 240, 10));
    EXPECT_EQ(window.nx, 48);
    EXPECT_EQ(window.ny, 48);
    EXPECT_GE(layout->seam(0, 0), 0);
    EXPECT_GE(layout->seam(0, 1), 0);
    expect_sound(windows);

    // A throat on the other side of the seam is within it, and gets a window of its own.
    ASSERT_EQ(layout->covered_by(-1, 250, 5), 0);
    const int     ix     = 3 * ((250 - window.x + 256) % 256) + 1;
    const int     iy     = 3 * ((5 - window.y + 256) % 256) + 1;
    const Windows nested = placed({throat(ix, iy, 0)}, windows);
    ASSERT_EQ(nested.size(), 2U);
    EXPECT_EQ(nested[1].parent, 0);
    EXPECT_TRUE(covers(nested[1], ix, iy));
    expect_sound(nested);
  }

  TEST(ZoomPlacement, JoinsNeighbours)
  {
    const Windows joined = placed({throat(100, 60), throat(140, 70)});
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_TRUE(joined[0] == (ZoomWindow{-1, 1, 76, 36, 88, 58}));
    // With one that was there, across the seam.
    const Windows across = placed({throat(10, 100)}, placed({throat(240, 100)}));
    ASSERT_EQ(across.size(), 1U);
    EXPECT_EQ(across[0].nx, 74);
    EXPECT_TRUE(covers(across[0], 216, 100));
    EXPECT_TRUE(covers(across[0], 33, 100));

    const Windows apart = placed({throat(40, 40), throat(130, 40)});
    EXPECT_EQ(apart.size(), 2U);
    expect_sound(apart);
  }

  // In a box that is not much larger than a window that was joined.
  TEST(ZoomPlacement, SeesNeighboursOnTheFarSideOfAWideOne)
  {
    const Windows near    = {{-1, 1, 60, 60, 100, 80}};
    const Windows windows = placed({throat(176, 100), throat(100, 100, 0)}, near);
    expect_sound(windows);
    const SlabLayoutPtr layout = box_with(windows);
    EXPECT_GE(layout->covered_by(-1, 176, 100), 0);
    // What lies far from the begin of a wide parent finds it.
    const Windows wide   = {{-1, 1, 10, 60, 150, 80}};
    const Windows nested = placed({throat(400, 120, 0)}, wide);
    expect_sound(nested);
    ASSERT_EQ(nested.size(), 2U);
    EXPECT_TRUE(covers(nested[1], 400, 120));
  }

  TEST(ZoomPlacement, LeavesOutWhatWouldMakeOneTooLarge)
  {
    const Windows windows =
      placed({throat(40, 40), throat(75, 40), throat(110, 40), throat(145, 40)});
    expect_sound(windows);
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_TRUE(covers(windows[0], 40, 40));
    EXPECT_TRUE(covers(windows[0], 110, 40));
    EXPECT_FALSE(covers(windows[0], 145, 40));
    EXPECT_LE(windows[0].nx, 144);
    // But it takes the place of one in which no throat lies any more.
    const Windows next = placed({throat(145, 40)}, windows);
    ASSERT_EQ(next.size(), 1U);
    EXPECT_TRUE(covers(next[0], 145, 40));
    EXPECT_EQ(next[0].nx, 48);
  }

  // In a small box one window may go all the way round, and no throat is forgotten.
  TEST(ZoomPlacement, GoesAllRoundASmallBox)
  {
    const int     n       = 128;
    const Windows before  = {{-1, 1, 10, 5, 100, 64}};
    const Windows windows = place_windows(*box_with(before, n), {throat(60, 110)}, zoom);
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_TRUE(covers(windows[0], 60, 110, n));
    EXPECT_TRUE(covers(windows[0], 60, 20, n));
    EXPECT_LE(windows[0].ny, n - 2);
    // Wherever in it a throat is, it gets a window, if need be once the rim is elsewhere.
    const int n_rows = windows[0].n_rows();
    for (const int row : {1, 5, 40, 200, n_rows - 40, n_rows - 6, n_rows - 2})
      {
        Windows nested = windows;
        int     iy     = row;
        for (const bool is_near_rim : {true, false})
          if (nested.size() == 1U && (!is_near_rim || row < 7 || row > n_rows - 8))
            {
              const int y_before = nested[0].y;
              nested = place_windows(*box_with(nested, n), {throat(150, iy, 0)}, zoom);
              expect_sound(nested);
              if (is_near_rim)
                iy = (iy + 3 * (y_before - nested[0].y + n)) % (3 * n);
            }
        ASSERT_EQ(nested.size(), 2U) << row;
        EXPECT_TRUE(covers(nested[1], 150, iy)) << row;
      }
    const Windows wide = {{-1, 1, 22, 42, 126, 111}};
    EXPECT_EQ(place_windows(*box_with(wide, n), {throat(49, 178, 0)}, zoom).size(), 2U);
  }

  TEST(ZoomPlacement, NestsLevelAfterLevel)
  {
    Windows windows;
    int     ix = 100, iy = 60;
    for (int level = 1; level <= zoom.maximum_levels; ++level)
      {
        const int parent = static_cast<int>(windows.size()) - 1;
        windows          = placed({throat(ix, iy, parent)}, windows);
        ASSERT_EQ(static_cast<int>(windows.size()), level);
        const ZoomWindow &finest = windows.back();
        EXPECT_EQ(finest.parent, parent);
        ASSERT_TRUE(covers(finest, ix, iy));
        expect_sound(windows);
        ix = 3 * (ix - finest.x) + 1;
        iy = 3 * (iy - finest.y) + 1;
      }
    EXPECT_TRUE(placed({throat(ix, iy, zoom.maximum_levels - 1)}, windows) == windows);
  }

  TEST(ZoomPlacement, FollowsAThroatThatComesNearARim)
  {
    const Windows windows = placed({throat(100, 60)});
    // Resolved, but its length reaches beyond.
    const Windows moved = placed({throat(138, 72, 0, 14.)}, windows);
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_TRUE(covers(moved[0], 122, 60));
    EXPECT_TRUE(covers(moved[0], 140, 60));
    EXPECT_TRUE(covers(moved[0], 100, 60));
    // In the middle it stays, as it does where it has points enough on the parent.
    EXPECT_TRUE(placed({throat(73, 72, 0, 14.)}, windows) == windows);
    EXPECT_TRUE(placed({throat(138, 72, 0, 40.)}, windows) == windows);
  }

  // Next to the rim, where no finer window fits, or that of a parent.
  TEST(ZoomPlacement, MakesRoomForFinerWindows)
  {
    const Windows windows = placed({throat(100, 60)});
    const Windows wider   = placed({throat(142, 72, 0)}, windows);
    ASSERT_EQ(wider.size(), 1U);
    EXPECT_TRUE(covers(wider[0], 140, 60));
    const int     ix     = 3 * (123 - wider[0].x) + 1;
    const int     iy     = 3 * (60 - wider[0].y) + 1;
    const Windows nested = placed({throat(ix, iy, 0)}, wider);
    ASSERT_EQ(nested.size(), 2U);
    EXPECT_TRUE(covers(nested[1], ix + 20, iy));

    const Windows two  = {{-1, 1, 60, 20, 80, 80}, {0, 2, 4, 80, 80, 80}};
    const Windows more = placed({throat(2, 100, 1)}, two);
    expect_sound(more);
    ASSERT_GE(more.size(), 2U);
    EXPECT_TRUE(covers(more[0], 45, 46));
  }

  // Windows that are joined do not change what the others are numbered by.
  TEST(ZoomPlacement, FindsThroatsAfterWindowsWereJoined)
  {
    const Windows before = {{-1, 1, 20, 20, 48, 48}, {-1, 1, 160, 160, 48, 48}};
    const Windows after =
      placed({throat(90, 44, -1, 5., .9), throat(73, 73, 1, 5.)}, before);
    expect_sound(after);
    ASSERT_EQ(after.size(), 3U);
    const SlabLayoutPtr layout = box_with(after);
    const auto          middle = layout->position(2, 72, 72);
    EXPECT_NEAR(middle[0], 184. / 256, 1. / 256);
    EXPECT_NEAR(middle[1], 184. / 256, 1. / 256);
  }

  // One that its parent's rim pushes aside comes to lie on another that it did not touch.
  TEST(ZoomPlacement, JoinsWhatTheRimOfTheParentPushesTogether)
  {
    const Windows parent  = placed({throat(100, 60)});
    const Windows windows = placed({throat(10, 120, 0), throat(95, 120, 0)}, parent);
    expect_sound(windows);
    const auto is_covered = [&](const int ix, const int iy) {
      return std::any_of(windows.begin() + 1, windows.end(), [&](const ZoomWindow &w) {
        return covers(w, ix, iy);
      });
    };
    EXPECT_TRUE(is_covered(10, 120));
    EXPECT_TRUE(is_covered(95, 120));
  }

  // A throat that moves round the box comes home.
  TEST(ZoomPlacement, StaysWithinABoxThatIsPeriodic)
  {
    Windows windows;
    for (int step = 0; step < 40; ++step)
      {
        const int           ix = 20 * step % 256, iy = 250;
        const SlabLayoutPtr layout = box_with(windows);
        ThroatOnPath        next   = throat(ix, iy);
        if (const int w = layout->covered_by(-1, ix, iy); w >= 0)
          next = throat(3 * ((ix - windows[w].x + 256) % 256) + 1,
                        3 * ((iy - windows[w].y + 256) % 256) + 1,
                        w,
                        14.);
        windows = place_windows(*layout, {next}, zoom);
        expect_sound(windows);
        ASSERT_EQ(box_with(windows)->covered_by(-1, ix, iy), 0) << step;
        ASSERT_LT(windows[0].x, 256) << step;
        ASSERT_GT(windows[0].x, -256 + ZoomWindow::margin) << step;
      }
  }

  // What lies in one that was pushed aside stays where it was.
  TEST(ZoomPlacement, ChildrenStayWhereTheirParentsAreMoved)
  {
    const Windows       two      = {{-1, 1, 60, 20, 80, 80},
                                    {0, 2, 4, 80, 80, 80},
                                    {1, 3, 8, 80, 80, 80}};
    const SlabLayoutPtr before   = box_with(two);
    const auto          expected = before->position(2, 0, 0);
    // Near the left rim of the second level, resolved; the window around it would reach
    // beyond the first level's rim and is joined with that which is there.
    const Windows windows = placed({throat(10, 200, 1, 14.)}, two);
    ASSERT_EQ(windows.size(), 3U);
    expect_sound(windows);
    EXPECT_FALSE(windows == two);
    const auto found = box_with(windows)->position(2, 0, 0);
    EXPECT_NEAR(found[0], expected[0], 1e-12);
    EXPECT_NEAR(found[1], expected[1], 1e-12);
  }

  const Windows three_levels = {{-1, 1, 60, 20, 80, 80},
                                {-1, 1, 160, 160, 80, 80},
                                {1, 2, 80, 80, 80, 80},
                                {2, 3, 80, 80, 80, 80}};

  TEST(ZoomPlacement, DropsWhatIsNotNeeded)
  {
    const auto needed = [](const std::vector<ThroatOnPath> &throats) {
      return needed_windows(*box_with(three_levels), throats, zoom);
    };
    // The other throat's window is gone, and parents are numbered anew.
    const Windows deepest = needed({throat(120, 120, 3, 15.)});
    ASSERT_EQ(deepest.size(), 3U);
    EXPECT_TRUE(deepest[0] == three_levels[1]);
    EXPECT_EQ(deepest[1].parent, 0);
    EXPECT_EQ(deepest[2].parent, 1);
    expect_sound(deepest);
    // One level more than needed stays, two do not.
    EXPECT_EQ(needed({throat(120, 120, 3, 9 * 11.9, 1.)}).size(), 3U);
    EXPECT_EQ(needed({throat(120, 120, 3, 9 * 12.1, 1.)}).size(), 2U);
    EXPECT_EQ(needed({throat(120, 120, 3, 27 * 12.1, 1.)}).size(), 1U);
    EXPECT_TRUE(needed({throat(120, 120, 3, 81 * 12.1, 1.)}).empty());
    EXPECT_TRUE(needed({throat(30, 30, -1, 15.)}).empty());
    EXPECT_TRUE(needed({throat(120, 120, 3, 15.), throat(120, 120, 0, 15.)}) ==
                three_levels);
  }
} // namespace
