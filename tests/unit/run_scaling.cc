// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/scaling.h>
#include <strait/run/step.h>

#include <gtest/gtest.h>

#include <cmath>

namespace strait
{
  namespace
  {
    /** A step near a threshold, whose leak rate is @p rate. */
    Step
    step_at(const double reduced_load, const double rate, const std::string &doubt = "")
    {
      Step step;
      step.reduced_load = reduced_load;
      step.flow.emplace();
      step.flow->leakage.rate = rate;
      step.flow->constrictions.emplace();
      step.theory.emplace();
      step.theory->leak_rate = rate * rate;
      if (!doubt.empty())
        step.doubts.push_back(doubt);
      return step;
    }

    Step
    coarse(Step step)
    {
      step.checks.push_back({"coarse-throat", 1., 3., "", true});
      return step;
    }

    struct Findings
    {
      std::vector<FitRow>      rows;
      RunSummary               summary;
      std::vector<std::string> warnings;
    };

    Findings
    findings_of(const Scaling &scaling, const std::vector<Transition> &thresholds = {})
    {
      Log      log(MPI_COMM_WORLD, true);
      Findings found{scaling.fits(log), {}, {}};
      scaling.summarise(thresholds, found.summary, log);
      found.warnings = log.warnings();
      return found;
    }

    RunSummary
    summary_of(const Scaling &scaling, const std::vector<Transition> &thresholds = {})
    {
      return findings_of(scaling, thresholds).summary;
    }

    TEST(Scaling, FitsResolvedStepsAlone)
    {
      Scaling scaling(.02);
      for (const double epsilon : {.02, .01, .005})
        scaling.collect(step_at(epsilon, std::pow(epsilon, 3.)));
      scaling.collect(step_at(.002, 1., "unresolved-throat"));
      EXPECT_NEAR(summary_of(scaling).exponent, 3., 1e-12);
      EXPECT_EQ(summary_of(scaling).status, "ok");

      const Findings found = findings_of(scaling);
      std::string    local;
      for (const FitRow &row : found.rows)
        if (row.kind == "local")
          local += row.status + " ";
        else
          {
            EXPECT_EQ(row.n_points, 3);
            EXPECT_EQ(row.status, "ok");
          }
      EXPECT_EQ(local, "ok ok unresolved-throat ");
      ASSERT_EQ(found.warnings.size(), 1U);
      EXPECT_EQ(
        found.warnings[0],
        "exponent of leak_rate: 3 of 4 steps with 1 - L/L_c from 0 to 0.02 serve; "
        "the others are left out for unresolved-throat");
    }

    TEST(Scaling, SaysWhatIsMissing)
    {
      Scaling scaling(.02);
      scaling.collect(step_at(.02, 1., "unresolved-throat"));
      scaling.collect(step_at(.01, .1));
      EXPECT_EQ(summary_of(scaling).status, "no-exponent");
      scaling.collect(step_at(.5, 10.));
      EXPECT_EQ(summary_of(scaling).status, "no-exponent")
        << "one step of two was asked for";
      scaling.collect(coarse(step_at(.3, 1.)));
      EXPECT_EQ(summary_of(scaling).status, "no-exponent+no-crossover");
      EXPECT_TRUE(std::isnan(summary_of(scaling).crossover));
      const Findings found = findings_of(scaling);
      for (const FitRow &row : found.rows)
        EXPECT_EQ(row.kind, "local");
      ASSERT_EQ(found.warnings.size(), 2U);
      EXPECT_EQ(found.warnings[1],
                "no crossover load, which takes two steps: 1 of 2 steps with 1 - L/L_c "
                "from 0.3 to 0.7 serve; the others are left out for coarse-throat");
    }

    TEST(Scaling, TheWindowOfTheLawIsThatOfTheFit)
    {
      // The largest load is there but for rounding, and one alone tells no exponent.
      Scaling scaling(.3);
      for (const double epsilon : {.30000000000000004, .2})
        scaling.collect(step_at(epsilon, std::pow(epsilon, 3.6)));
      std::vector<double> laws;
      for (const FitRow &row : findings_of(scaling).rows)
        if (row.quantity == "leak_rate" && row.kind == "local")
          laws.push_back(row.law);
      ASSERT_EQ(laws.size(), 1U);
      EXPECT_NEAR(laws[0], 3.6, 1e-6);
      Scaling twice(.3);
      for (const double epsilon : {.3, .3})
        twice.collect(step_at(epsilon, std::pow(epsilon, 3.6)));
      EXPECT_TRUE(findings_of(twice).rows.empty());
      EXPECT_TRUE(std::isnan(summary_of(twice).exponent));
    }

    // Of several slip lengths the summary speaks for the least, even where that has none.
    TEST(Scaling, TakesNoOtherSlipForTheLeast)
    {
      Scaling scaling(.02);
      for (const double epsilon : {.02, .01})
        {
          Step failed = step_at(epsilon, 1.);
          failed.flow.reset();
          scaling.collect(failed);
          Step slips                      = step_at(epsilon, std::pow(epsilon, 3.));
          slips.state.control.slip_length = -.1;
          scaling.collect(slips);
        }
      EXPECT_TRUE(std::isnan(summary_of(scaling).exponent));
      EXPECT_EQ(summary_of(scaling).status, "no-exponent");
    }

    // exp(s ε) has its crossover at 69/(20 s); a coarse throat must not spoil it, and one
    // that exponents cannot be told from does not. The theory's is from the same steps.
    TEST(Scaling, CrossoverOfResolvedSteps)
    {
      Scaling scaling(.02);
      for (const double epsilon : {.7, .6, .5})
        scaling.collect(step_at(epsilon, std::exp(10. * epsilon), "unresolved-throat"));
      scaling.collect(coarse(step_at(.3, 1e-9)));
      EXPECT_NEAR(summary_of(scaling).crossover, .345, 1e-12);
      // Of several slip lengths the least counts, wherever it stands.
      const RunSummary summary = summary_of(scaling, {{-.1, 1., 1.}, {0., 2., 2.}});
      EXPECT_NEAR(summary.crossover_load, 2. * (1. - .345), 1e-12);
      EXPECT_NEAR(summary.theory_crossover_load, 2. * (1. - .1725), 1e-12);
      EXPECT_EQ(summary_of(scaling).status, "ok");
    }

    // A decay of less than the power law's exponent never comes to it: the crossover
    // would be at a negative load.
    TEST(Scaling, NoCrossoverOfSlowDecay)
    {
      const auto crossover = [](const double slope) {
        Scaling scaling(.02);
        for (const double epsilon : {.7, .5, .3})
          scaling.collect(step_at(epsilon, std::exp(slope * epsilon)));
        return summary_of(scaling).crossover;
      };
      EXPECT_NEAR(crossover(6.9), .5, 1e-12);
      EXPECT_NEAR(crossover(3.46), 3.45 / 3.46, 1e-12);
      for (const double slope : {3.44, 1., 0., -5.})
        EXPECT_TRUE(std::isnan(crossover(slope))) << slope;

      // The leak rate alone is too slow: the theory's is its square.
      Scaling scaling(.02);
      for (const double epsilon : {.7, .5})
        scaling.collect(step_at(epsilon, std::exp(3. * epsilon)));
      const RunSummary summary = summary_of(scaling, {{0., 2., 2.}});
      EXPECT_TRUE(std::isnan(summary.crossover));
      EXPECT_TRUE(std::isnan(summary.crossover_load));
      EXPECT_NEAR(summary.theory_crossover_load, 2. * (1. - .575), 1e-12);
      EXPECT_EQ(summary.status, "no-crossover");
      const std::vector<std::string> warnings = findings_of(scaling).warnings;
      ASSERT_EQ(warnings.size(), 1U);
      EXPECT_EQ(warnings[0],
                "no crossover load of the leak rate: its logarithm rises by less than "
                "69/20 times 1 - L/L_c from 0.3 to 0.7");

      // Both are, and the status speaks of the leak rate alone.
      Scaling slow(.02);
      for (const double epsilon : {.7, .5})
        slow.collect(step_at(epsilon, std::exp(epsilon)));
      EXPECT_TRUE(std::isnan(summary_of(slow, {{0., 2., 2.}}).theory_crossover_load));
      EXPECT_EQ(summary_of(slow).status, "no-crossover");
      EXPECT_EQ(findings_of(slow).warnings.size(), 2U);
    }

    TEST(Scaling, WordsAreJoinedOnce)
    {
      std::string all = "ok";
      add_words(all, "ok");
      EXPECT_EQ(all, "ok");
      add_words(all, "a+b");
      add_words(all, "b+c");
      add_words(all, "ok");
      EXPECT_EQ(all, "a+b+c");
    }
  } // namespace
} // namespace strait
