// SPDX-License-Identifier: GPL-2.0-or-later
// How windows change when throats move, grow or become resolved.
#include <algorithm>

#include "zoom_tools.h"

namespace
{
  using namespace zoom_tests;

  TEST(ZoomPlacement, FollowsAThroatThatComesNearARim)
  {
    const Windows windows = placed({throat(100, 60)});
    // The throat is resolved, but its length reaches beyond the rim.
    const Windows moved = placed({throat(138, 72, 0, 14.)}, windows);
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_TRUE(covers(moved[0], 122, 60));
    EXPECT_TRUE(covers(moved[0], 140, 60));
    EXPECT_TRUE(covers(moved[0], 100, 60));
    // The window stays if the throat is in its middle, or resolved on the parent.
    EXPECT_TRUE(placed({throat(73, 72, 0, 14.)}, windows) == windows);
    EXPECT_TRUE(placed({throat(138, 72, 0, 40.)}, windows) == windows);
  }

  // Next to a rim, no finer window fits: the coarsest window with a rim there is widened.
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

  // Throats name windows by numbers, which must hold while windows are joined.
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

  // A window that is moved off its parent's rim may come to lie on another one.
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

  // The throat moves around the periodic box three times.
  TEST(ZoomPlacement, StaysWithinABoxThatIsPeriodic)
  {
    Windows windows;
    for (int step = 0; step < 40; ++step)
      {
        const int           ix = 20 * step % 256, iy = 250;
        const SlabLayoutPtr layout = box_with(windows);
        ThroatOnPath        next   = throat(ix, iy);
        if (const auto fine = layout->finer({ix, iy}))
          next = throat(fine->ix, fine->iy, fine->window, 14.);
        windows = place_windows(*layout, {next}, zoom);
        expect_sound(windows);
        ASSERT_TRUE(box_with(windows)->finer({ix, iy}).has_value()) << step;
        ASSERT_LT(windows[0].x, 256) << step;
        ASSERT_GT(windows[0].x, -256 + ZoomWindow::margin) << step;
      }
  }

  // A window inside one that is moved stays where it was.
  TEST(ZoomPlacement, ChildrenStayWhereTheirParentsAreMoved)
  {
    const Windows       two      = {{-1, 1, 60, 20, 80, 80},
                                    {0, 2, 4, 80, 80, 80},
                                    {1, 3, 8, 80, 80, 80}};
    const SlabLayoutPtr before   = box_with(two);
    const auto          expected = before->position(2, 0, 0);
    // A resolved throat near the left rim of the second level. A new window around it
    // would reach beyond the rim of the first level, and is joined with the existing one.
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
    // The window of the other throat is dropped, and parents are renumbered.
    const Windows deepest = needed({throat(120, 120, 3, 15.)});
    ASSERT_EQ(deepest.size(), 3U);
    EXPECT_TRUE(deepest[0] == three_levels[1]);
    EXPECT_EQ(deepest[1].parent, 0);
    EXPECT_EQ(deepest[2].parent, 1);
    expect_sound(deepest);
    // One level more than needed is kept, two are not.
    EXPECT_EQ(needed({throat(120, 120, 3, 9 * 11.9, 1.)}).size(), 3U);
    EXPECT_EQ(needed({throat(120, 120, 3, 9 * 12.1, 1.)}).size(), 2U);
    EXPECT_EQ(needed({throat(120, 120, 3, 27 * 12.1, 1.)}).size(), 1U);
    EXPECT_TRUE(needed({throat(120, 120, 3, 81 * 12.1, 1.)}).empty());
    EXPECT_TRUE(needed({throat(30, 30, -1, 15.)}).empty());
    EXPECT_TRUE(needed({throat(120, 120, 3, 15.), throat(120, 120, 0, 15.)}) ==
                three_levels);
  }
} // namespace
