// SPDX-License-Identifier: GPL-2.0-or-later
// Where windows are placed around given throats.
#include "zoom_tools.h"

namespace
{
  using namespace zoom_tests;

  TEST(ZoomPlacement, OpensAWindowAroundAThroat)
  {
    const Windows windows = placed({throat(100, 60)});
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_TRUE(windows[0] == (ZoomWindow{-1, 1, 76, 36, 48, 48}));
  }

  TEST(ZoomPlacement, OpensNoneWhereNothingIsLacking)
  {
    EXPECT_TRUE(placed({throat(100, 60, -1, 12.)}).empty());
    // A throat with a quarter of the pressure drop needs half of the points.
    EXPECT_TRUE(placed({throat(100, 60, -1, 6.1, .25)}).empty());
    EXPECT_EQ(placed({throat(100, 60, -1, 5.9, .25)}).size(), 1U);
    // Existing windows stay.
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

    // A throat across the seam lies in this window, and gets one of its own.
    const auto fine = layout->finer({250, 5});
    ASSERT_TRUE(fine.has_value());
    const Windows nested = placed({throat(fine->ix, fine->iy, 0)}, windows);
    ASSERT_EQ(nested.size(), 2U);
    EXPECT_EQ(nested[1].parent, 0);
    EXPECT_TRUE(covers(nested[1], fine->ix, fine->iy));
    expect_sound(nested);
  }

  TEST(ZoomPlacement, JoinsNeighbours)
  {
    const Windows joined = placed({throat(100, 60), throat(140, 70)});
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_TRUE(joined[0] == (ZoomWindow{-1, 1, 76, 36, 88, 58}));
    // A new window is joined with an existing one across the seam.
    const Windows across = placed({throat(10, 100)}, placed({throat(240, 100)}));
    ASSERT_EQ(across.size(), 1U);
    EXPECT_EQ(across[0].nx, 74);
    EXPECT_TRUE(covers(across[0], 216, 100));
    EXPECT_TRUE(covers(across[0], 33, 100));

    const Windows apart = placed({throat(40, 40), throat(130, 40)});
    EXPECT_EQ(apart.size(), 2U);
    expect_sound(apart);
  }

  // The box is not much larger than a window that was joined.
  TEST(ZoomPlacement, SeesNeighboursOnTheFarSideOfAWideOne)
  {
    const Windows near    = {{-1, 1, 60, 60, 100, 80}};
    const Windows windows = placed({throat(176, 100), throat(100, 100, 0)}, near);
    expect_sound(windows);
    const SlabLayoutPtr layout = box_with(windows);
    EXPECT_TRUE(layout->finer({176, 100}).has_value());
    // A throat far from the first column of a wide window is found in it.
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
    // But a new window replaces one in which no throat lies any more.
    const Windows next = placed({throat(145, 40)}, windows);
    ASSERT_EQ(next.size(), 1U);
    EXPECT_TRUE(covers(next[0], 145, 40));
    EXPECT_EQ(next[0].nx, 48);
  }

  // In a small box, one window may go all the way around; no throat is forgotten.
  TEST(ZoomPlacement, GoesAllRoundASmallBox)
  {
    const int     n       = 128;
    const Windows before  = {{-1, 1, 10, 5, 100, 64}};
    const Windows windows = place_windows(*box_with(before, n), {throat(60, 110)}, zoom);
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_TRUE(covers(windows[0], 60, 110, n));
    EXPECT_TRUE(covers(windows[0], 60, 20, n));
    EXPECT_LE(windows[0].ny, n - 2);
    // Any throat in the window gets a finer one; near the rim, once that has moved.
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
} // namespace
