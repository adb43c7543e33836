// SPDX-License-Identifier: GPL-2.0-or-later
// Searches for the value at which small steps along a path lose a state.
#include <strait/seal/transition_search.h>

#include <gtest/gtest.h>

#include <cmath>

#include "passage_width.h"

namespace strait
{
  namespace
  {
    constexpr double tolerance = 1e-4;

    const auto is_open = [](const Probe &probe) { return probe.openness > 0; };

    /** A search in a seal that is open where rule(value). */
    template <typename Rule>
    TransitionSearch
    searching(const Rule &rule)
    {
      return TransitionSearch(
        [rule](const double value) {
          Probe result;
          result.openness = rule(value) ? 1. : -1.;
          return result;
        },
        tolerance);
    }

    /** A state on a path upwards: steps of at most a tenth keep it up to `limit`, larger
     *  ones lose it beyond 1. */
    class Keeper
    {
    public:
      explicit Keeper(const double limit_)
        : limit(limit_)
      {
      }

      bool
      keeps(const double value)
      {
        ++n_asked;
        const bool far   = std::abs(value - kept) > .1 * kept;
        const bool stays = value <= (far ? 1. : limit);
        if (stays)
          kept = value;
        return stays;
      }

      double kept    = .5;
      int    n_asked = 0;

    private:
      const double limit;
    };

    TEST(SlowApproach, GoesOnWhereALargeStepWasTooLarge)
    {
      Keeper           state(1.37);
      TransitionSearch search =
        searching([&](const double value) { return state.keeps(value); });
      const auto found = search.enclose_loss(.5, 1., is_open, 1.2);
      ASSERT_TRUE(found);
      EXPECT_LE(found->before, 1.37);
      EXPECT_GT(found->beyond, 1.37);
      EXPECT_LE(relative_width(*found), tolerance);
      EXPECT_EQ(found->before, state.kept);
      EXPECT_LE(state.n_asked, 50);
    }

    TEST(SlowApproach, AsksOnceMoreWhereTheStepDoesNotMatter)
    {
      int              n_asked = 0;
      TransitionSearch search  = searching([&](double) { return ++n_asked == 0; });
      const auto       found   = search.enclose_loss(1., 1., is_open, 1. + tolerance);
      ASSERT_TRUE(found);
      EXPECT_EQ(n_asked, 1);
      EXPECT_EQ(found->before, 1.);
      EXPECT_EQ(found->beyond, 1. + tolerance);
    }

    TEST(SlowApproach, GoesDownAsWell)
    {
      TransitionSearch search = searching([](const double value) { return value >= .3; });
      const auto       found  = search.enclose_loss(1., -1., is_open, .9);
      ASSERT_TRUE(found);
      EXPECT_GE(found->before, .3);
      EXPECT_LT(found->beyond, .3);
      EXPECT_LE(relative_width(*found), tolerance);
    }

    TEST(SlowApproach, SaysThatAStateIsNeverLost)
    {
      TransitionSearch search = searching([](double) { return true; });
      EXPECT_FALSE(search.enclose_loss(1., -1., is_open, .9));
      EXPECT_FALSE(search.enclose_loss(1., 1., is_open, 1.1));
      EXPECT_FALSE(search.enclose_loss(1., 1., is_open));
    }

    TEST(SlowApproach, LeavesInSmallStepsDownAndInLargeOnesUp)
    {
      // On the way down from 1, a step of more than a tenth closes the seal at 0.9,
      // smaller ones only at 0.2.
      double           open      = 1.;
      TransitionSearch downwards = searching([&](const double pressure) {
        const bool stays = pressure > (open - pressure > .1 * open ? .9 : .2);
        if (stays)
          open = pressure;
        return stays;
      });
      const auto       closing   = downwards.enclose_loss(1., -tolerance, is_open);
      ASSERT_TRUE(closing);
      EXPECT_LE(closing->beyond, .2);
      EXPECT_GT(closing->before, .2);
      EXPECT_LE(relative_width(*closing), tolerance);

      Keeper           held(1.37);
      TransitionSearch upwards =
        searching([&](const double value) { return held.keeps(value); });
      const auto opening = upwards.enclose_loss(.5, .5, is_open);
      ASSERT_TRUE(opening);
      EXPECT_LE(opening->before, 1.37);
      EXPECT_GT(opening->beyond, 1.37);
      EXPECT_LE(relative_width(*opening), tolerance);
    }
  } // namespace
} // namespace strait
