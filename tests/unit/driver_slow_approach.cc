// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/blow_out.h>
#include <strait/driver/slow_approach.h>
#include <strait/driver/threshold_search.h>

#include <gtest/gtest.h>

#include <cmath>

namespace strait
{
  namespace
  {
    constexpr double tolerance = 1e-4;

    /** A state that steps of at most a tenth keep up to @p limit, and that larger ones
     *  lose beyond 1, on a way up. */
    class Keeper
    {
    public:
      explicit Keeper(const double limit_)
        : limit(limit_)
      {
      }

      bool
      is_lost(const double value)
      {
        ++n_asked;
        const bool far  = std::abs(value - kept) > .1 * kept;
        const bool lost = value > (far ? 1. : limit);
        if (!lost)
          kept = value;
        return lost;
      }

      double kept    = .5;
      int    n_asked = 0;

    private:
      const double limit;
    };

    TEST(SlowApproach, GoesOnWhereALargeStepWasTooLarge)
    {
      Keeper     state(1.37);
      const auto found = approach_slowly({.5, 1.2}, tolerance, [&](const double value) {
        return state.is_lost(value);
      });
      ASSERT_TRUE(found);
      EXPECT_LE(found->before, 1.37);
      EXPECT_GT(found->beyond, 1.37);
      EXPECT_LE(found->beyond - found->before, tolerance * found->beyond);
      EXPECT_EQ(found->before, state.kept);
      EXPECT_LE(state.n_asked, 50);
    }

    TEST(SlowApproach, AsksOnceMoreWhereTheStepDoesNotMatter)
    {
      int        n_asked = 0;
      const auto found   = approach_slowly({1., 1. + tolerance}, tolerance, [&](double) {
        ++n_asked;
        return true;
      });
      ASSERT_TRUE(found);
      EXPECT_EQ(n_asked, 1);
      EXPECT_EQ(found->before, 1.);
      EXPECT_EQ(found->beyond, 1. + tolerance);
    }

    TEST(SlowApproach, GoesDownAsWell)
    {
      const auto found = approach_slowly({1., .9}, tolerance, [](const double value) {
        return value < .3;
      });
      ASSERT_TRUE(found);
      EXPECT_GE(found->before, .3);
      EXPECT_LT(found->beyond, .3);
      EXPECT_LE(found->before - found->beyond, tolerance * found->before);
    }

    TEST(SlowApproach, SaysThatAStateIsNeverLost)
    {
      const auto never = [](double) { return false; };
      EXPECT_FALSE(approach_slowly({1., .9}, tolerance, never));
      EXPECT_FALSE(approach_slowly({1., 1.1}, tolerance, never));
    }

    TEST(SlowApproach, FindsTheReSealingOfSmallSteps)
    {
      // From 1 down, steps of more than a tenth close at once what others keep open.
      double     open    = 1.;
      int        n_asked = 0;
      const auto probe   = [&](const double pressure) {
        BlowOutProbe result;
        result.leaks = pressure > (open - pressure > .1 * open ? .9 : .2);
        if (result.leaks)
          open = pressure;
        return result;
      };
      const Resealing found = find_resealing(probe, 1., tolerance, n_asked);
      EXPECT_LE(found.lower, .2);
      EXPECT_GT(found.upper, .2);
      EXPECT_LE(found.upper - found.lower, tolerance * found.upper);
    }

    TEST(SlowApproach, FindsTheThresholdAndTheBlowOutOfSmallSteps)
    {
      Keeper     open(1.37);
      const auto probe = [&](const double load) {
        ThresholdProbe result;
        result.bottleneck.value = open.is_lost(load) ? -.1 * load : 2. - load;
        return result;
      };
      const Threshold threshold =
        ThresholdSearch(probe, .8, tolerance).find_slowly(0., true);
      EXPECT_LE(threshold.lower, 1.37);
      EXPECT_GT(threshold.upper, 1.37);
      EXPECT_LE(threshold.relative_width(), tolerance);
      EXPECT_EQ(threshold.n_solves, open.n_asked);

      Keeper        held(1.37);
      const BlowOut blow_out = find_blow_out(
        [&](const double pressure) {
          BlowOutProbe result;
          result.leaks = held.is_lost(pressure);
          return result;
        },
        .8,
        tolerance);
      EXPECT_LE(blow_out.lower, 1.37);
      EXPECT_GT(blow_out.upper, 1.37);
      EXPECT_LE(blow_out.upper - blow_out.lower, tolerance * blow_out.upper);
    }
  } // namespace
} // namespace strait
