// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/wall_feedback.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    /** A seal whose fluid has the same pressure p everywhere: next(p) follows from the
     *  assumed p, and the channel is open if open(p). */
    class UniformSeal
    {
    public:
      UniformSeal(std::function<double(double)> next_,
                  std::function<bool(double)>   open_,
                  const FeedbackParameters     &parameters = FeedbackParameters(),
                  const double                  share      = 1.)
        : layout(make_layout({8, 6, 1., 1.}, MPI_COMM_WORLD))
        , next(std::move(next_))
        , open(std::move(open_))
        , feedback(parameters, layout, share)
      {
      }

      FeedbackResult
      solve(const double start, const FeedbackGoal &goal)
      {
        feedback.pressure() = SlabField(layout, start);
        return go_on(goal);
      }

      FeedbackResult
      go_on(const FeedbackGoal &goal)
      {
        return feedback.solve(
          [&](const SlabField &assumed) {
            pressure = mean(assumed);
            largest  = std::max(largest, pressure);
            FeedbackRound result;
            result.percolates     = open(pressure);
            result.leak_rate      = result.percolates ? leak(pressure) : 0.;
            result.fluid_pressure = SlabField(layout, next(pressure));
            return result;
          },
          1.,
          goal);
      }

      double pressure = 0.; // assumed in the last round
      double largest  = 0.; // of all assumed ones

      std::function<double(double)> leak = [](const double p) { return std::exp(p); };

    private:
      SlabLayoutPtr                 layout;
      std::function<double(double)> next;
      std::function<bool(double)>   open;
      WallFeedback                  feedback;
    };

    constexpr double feedback_tolerance = 1e-6;

    bool
    always(const double)
    {
      return true;
    }

    TEST(WallFeedback, FindsTheStateThatPlainRoundsLeave)
    {
      UniformSeal seal([](const double p) { return .3 - 1.4 * (p - .3); }, always);
      const FeedbackResult result =
        seal.solve(.5, {feedback_tolerance, feedback_tolerance});
      EXPECT_TRUE(result.converged);
      EXPECT_LE(result.iterations, 6);
      EXPECT_NEAR(seal.pressure, .3, feedback_tolerance);
    }

    TEST(WallFeedback, LeavesAStateThatRelaxationLeadsAwayFrom)
    {
      // Two rounds near the fixed point 0.3 reveal where it is, and that it repels.
      UniformSeal seal(
        [](const double p) { return p < .5 ? .3 + 1.5 * (p - .3) : .6 + .2 * (p - .6); },
        always);
      EXPECT_TRUE(seal.solve(.31, {feedback_tolerance, feedback_tolerance}).converged);
      EXPECT_NEAR(seal.pressure, .6, 2. * feedback_tolerance);
    }

    TEST(WallFeedback, TheLeakRateMustHaveSettledToo)
    {
      // Even if the pressure is right at once, one round says nothing of the leak rate.
      UniformSeal seal([](const double) { return .3; }, always);
      EXPECT_EQ(seal.solve(.3, {feedback_tolerance, feedback_tolerance}).iterations, 2);
      EXPECT_EQ(seal.solve(.3, {feedback_tolerance, 1.}).iterations, 1);
      UniformSeal sealed([](const double) { return .3; },
                         [](const double) { return false; });
      EXPECT_EQ(sealed.solve(.3, {feedback_tolerance, feedback_tolerance}).iterations, 1);
    }

    TEST(WallFeedback, GoesOnFromTheLastImage)
    {
      FeedbackParameters plain;
      plain.plain_rounds = true;
      const auto   next  = [](const double p) { return .3 + .5 * (p - .3); };
      UniformSeal  seal(next, always, plain);
      FeedbackGoal goal{1e-2, 1e-2};
      seal.solve(.5, goal);
      const double before = seal.pressure;
      goal.continues      = true;
      EXPECT_EQ(seal.go_on(goal).iterations, 1);
      EXPECT_NEAR(seal.pressure, next(before), 1e-12);
    }

    TEST(WallFeedback, AnOpenChannelMayBeAllThatIsAskedFor)
    {
      const auto         open = [](const double p) { return p > .4; };
      const auto         next = [](const double p) { return .9 + .8 * (p - .9); };
      FeedbackParameters plain;
      plain.plain_rounds = true;
      FeedbackGoal exact{feedback_tolerance, std::numeric_limits<double>::infinity()};
      FeedbackGoal goal = exact;
      goal.once_open    = .1;
      UniformSeal          seal(next, open, plain);
      const FeedbackResult roughly = seal.solve(.2, goal);
      EXPECT_TRUE(roughly.converged);
      EXPECT_LE(std::max(roughly.change, roughly.leak_change), .1);
      EXPECT_GT(roughly.change, .01);
      UniformSeal same(next, open, plain);
      EXPECT_LE(same.solve(.2, exact).change, feedback_tolerance);
      // A channel that stays closed has to be as accurate as ever.
      UniformSeal closed(
        next, [](const double) { return false; }, plain);
      EXPECT_LE(closed.solve(.2, goal).change, feedback_tolerance);
      // The tolerance is in units of the relaxation, because small steps change little.
      plain.relaxation = .1;
      UniformSeal damped(next, open, plain);
      EXPECT_LE(damped.solve(.45, goal).leak_change, .01);
    }

    TEST(WallFeedback, SmallStepsKeepAVerdictThatLargeOnesLose)
    {
      // Below 0.2 the channel is closed and stays closed; a full first step leads there.
      const auto open = [](const double p) { return p > .2; };
      const auto next = [open](const double p) {
        return open(p) ? .5 - 3. * (p - .5) : .1;
      };
      FeedbackGoal goal{feedback_tolerance, feedback_tolerance};
      UniformSeal  large(next, open);
      EXPECT_TRUE(large.solve(.7, goal).converged);
      EXPECT_NEAR(large.pressure, .1, feedback_tolerance);
      goal.verdict = true;
      UniformSeal          also_large(next, open);
      const FeedbackResult lost = also_large.solve(.7, goal);
      EXPECT_FALSE(lost.converged);
      EXPECT_EQ(lost.iterations, 2);
      UniformSeal small(next, open, {}, .1);
      EXPECT_TRUE(small.solve(.7, goal).converged);
      EXPECT_NEAR(small.pressure, .5, feedback_tolerance);
      goal.verdict = false;
      EXPECT_EQ(small.solve(.7, goal).iterations, 1);
    }

    TEST(WallFeedback, OpensAndClosesWhereNeitherFluidKeepsItsChannel)
    {
      // Only a verdict can be had: the seal leaks, but no state tells how much.
      constexpr double any  = std::numeric_limits<double>::infinity();
      const auto       open = [](const double p) { return p > .4; };
      UniformSeal      seal([open](const double p) { return open(p) ? .1 : .8; }, open);
      EXPECT_TRUE(seal.solve(.5, {feedback_tolerance, any}).converged);
      EXPECT_TRUE(open(seal.pressure));
      EXPECT_NEAR(seal.pressure, .4, 1e-3); // where the steps have become small
      EXPECT_FALSE(seal.solve(.5, {feedback_tolerance, .1}).converged);
    }

    TEST(WallFeedback, ACycleThroughAnOpenChannelLeaks)
    {
      // The closed channel fills and opens above 0.6 only, the open one drains and closes
      // below 0.3 only: rounds go in a cycle without any state in which the two agree.
      bool       is_open = false;
      const auto open    = [&is_open](const double p) {
        is_open = p > (is_open ? .3 : .6);
        return is_open;
      };
      UniformSeal seal([&is_open](const double) { return is_open ? 0. : 1.; }, open);
      const FeedbackResult verdict =
        seal.solve(.5, {feedback_tolerance, std::numeric_limits<double>::infinity()});
      EXPECT_TRUE(verdict.converged);
      EXPECT_TRUE(is_open);
      EXPECT_GT(verdict.change, .1);
      EXPECT_FALSE(seal.solve(.5, {feedback_tolerance, .1}).converged);
    }

    TEST(WallFeedback, LeavesAJumpWhereNoStateLies)
    {
      // Far from the jump at 0.4, rounds cross it again and again. Near it, the fluid of
      // the open channel opens it further, to a fixed point at 0.55.
      const auto open = [](const double p) { return p > .4; };
      const auto next = [open](const double p) {
        return open(p) ? (p > .7 ? .35 : .55 + .1 * (p - .55)) : .9;
      };
      UniformSeal          seal(next, open);
      const FeedbackResult result =
        seal.solve(.9, {feedback_tolerance, feedback_tolerance});
      EXPECT_TRUE(result.converged) << result.iterations;
      EXPECT_NEAR(seal.pressure, .55, 2. * feedback_tolerance);
    }

    TEST(WallFeedback, FindsTheGapThatStaysAjar)
    {
      // A closed gap fills and opens, an open one drains and closes: a mixture agrees.
      const double         coarse = 1e-3;
      UniformSeal          seal([](const double p) { return p < .5 ? .9 : .2; }, always);
      const FeedbackResult result = seal.solve(.8, {coarse, coarse});
      EXPECT_TRUE(result.converged);
      EXPECT_LE(result.iterations, 150);
      EXPECT_LE(result.change, coarse);
      EXPECT_NEAR(seal.pressure, .5, 2. * coarse);
    }

    TEST(WallFeedback, AGapThatStaysAjarLeaksAsOnEitherSide)
    {
      const double coarse = 1e-3;
      UniformSeal  seal([](const double p) { return p < .5 ? .9 : .2; }, always);
      seal.leak                   = [](const double p) { return p < .5 ? 1. : 1.25; };
      const FeedbackResult result = seal.solve(.8, {coarse, coarse});
      EXPECT_TRUE(result.converged);
      EXPECT_NEAR(result.leak_change, .25, 1e-12);
      // A leak rate that still drifts in one direction has not settled.
      UniformSeal creeping([](const double p) { return p + 5e-4; }, always);
      creeping.leak = [](const double p) { return std::exp(40. * p); };
      EXPECT_FALSE(creeping.solve(.1, {coarse, coarse}).converged);
    }

    TEST(WallFeedback, DoesNotTakeASlowWalkForAState)
    {
      // Each round changes more than the tolerance, all in one direction.
      UniformSeal          seal([](const double p) { return p + .01; }, always);
      const FeedbackResult result = seal.solve(.1, {1e-3, 1e-3});
      EXPECT_FALSE(result.converged);
    }

    TEST(WallFeedback, GuessesNoMoreThanTheLoad)
    {
      // A combination of two rounds that differ little overshoots; plain rounds do not.
      const auto next = [](const double p) {
        return p < .5 ? p + .1 - .09 * p : .62 + .1 * (p - .62);
      };
      for (const double limit : {.7, std::numeric_limits<double>::infinity()})
        {
          UniformSeal  seal(next, always);
          FeedbackGoal goal{feedback_tolerance, feedback_tolerance};
          goal.largest_mean = limit;
          EXPECT_TRUE(seal.solve(.1, goal).converged);
          EXPECT_NEAR(seal.pressure, .62, 1e-5);
          EXPECT_EQ(seal.largest < .7, std::isfinite(limit));
        }
    }
  } // namespace
} // namespace strait
