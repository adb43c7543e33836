// SPDX-License-Identifier: GPL-2.0-or-later
// Searches for a known transition.
#include <strait/base/exceptions.h>
#include <strait/seal/transition_search.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "passage_width.h"

namespace strait
{
  namespace
  {
    // Exponents of a throat that is about to close; not quite those of the search.
    constexpr double of_gap = 1.16, of_pressure = .58;

    /** A constriction that closes at @p critical by the power laws of the saddle. */
    TransitionSearch::Ask
    constriction(const double critical, int &n_probes)
    {
      return [critical, &n_probes](const double load) {
        ++n_probes;
        const double open = 1 - load / critical;
        Probe        result;
        result.openness =
          open > 0 ? .8 * std::pow(open, of_gap) : -.003 * std::pow(-open, of_pressure);
        result.contact_area = load;
        return result;
      };
    }

    TEST(TransitionSearch, EnclosesTheThresholdInFewSolves)
    {
      for (const double critical : {.21, 1.436, 1.9, .6})
        {
          int                 n_probes = 0;
          TransitionSearch    search(constriction(critical, n_probes), 1e-4);
          const EnclosingPair found = search.enclose({1.25}, 0.);
          EXPECT_LE(found.before, critical);
          EXPECT_GE(found.beyond, critical);
          EXPECT_LE(relative_width(found), 1e-4);
          EXPECT_DOUBLE_EQ(search.at(found.before).contact_area, found.before);
          EXPECT_LE(n_probes, 18) << critical;
        }
    }

    TEST(TransitionSearch, AStartThatKnowsHowNearItIsTakesFewerSolves)
    {
      int              n_far = 0, n_near = 0;
      TransitionSearch far(constriction(1.436, n_far), 1e-6);
      TransitionSearch near(constriction(1.436, n_near), 1e-6);
      far.enclose({1.25}, 0.);
      const EnclosingPair found = near.enclose({1.43605, 5e-5}, 0.);
      EXPECT_LE(found.before, 1.436);
      EXPECT_GE(found.beyond, 1.436);
      EXPECT_LE(relative_width(found), 1e-6);
      EXPECT_LT(n_near, n_far);
    }

    /** The same on a grid with @p per_root points along the throat at an openness of one.
     *  Below half a point, their number no longer follows the root. */
    TransitionSearch::Ask
    constriction_on_points(const double critical, const double per_root, int &n_probes)
    {
      return [=, &n_probes](const double load) {
        Probe result  = constriction(critical, n_probes)(load);
        result.points = per_root * std::sqrt(std::max(result.openness, 0.));
        if (result.points < .5)
          result.points *= result.points / .5;
        return result;
      };
    }

    TEST(TransitionSearch, UnresolvedDistanceIsIndependentOfTheSearch)
    {
      // The distance ε at which 8 √(0.8 ε^1.16) is a half.
      const double expected = std::pow(std::pow(.5 / 8., 2) / .8, 1. / of_gap);
      const auto   within   = [](const SearchStart first, const double level) {
        int                 n_probes = 0;
        TransitionSearch    search(constriction_on_points(1.436, 8., n_probes), 1e-5);
        const EnclosingPair found = search.enclose(first, level);
        const int           n     = n_probes;
        const double        far   = search.unresolved_distance(found, level);
        EXPECT_LE(n_probes, n + 12);
        return far;
      };
      // From far away, and with all answers next to the transition.
      for (const SearchStart first : {SearchStart{1.25}, {1.6}, {1.43605, 3e-5}})
        EXPECT_NEAR(within(first, 0.) / expected, 1., .1); // the search assumes 6/5

      // If the throat was only seen with less than half a point along it, nothing is
      // known, unless more values may be asked.
      int                 n_asked = 0;
      TransitionSearch    next_to_it(constriction_on_points(1.436, 8., n_asked), 1e-5);
      const EnclosingPair near   = next_to_it.enclose({1.43605, 3e-5}, 0.);
      const int           n_near = n_asked;
      EXPECT_TRUE(std::isnan(next_to_it.unresolved_distance(near, 0., false)));
      EXPECT_EQ(n_asked, n_near);

      // Nothing is known either if the number of points is not.
      int                 n_probes = 0;
      TransitionSearch    search(constriction(1.436, n_probes), 1e-5);
      const EnclosingPair found = search.enclose({1.25}, 0.);
      const int           n     = n_probes;
      EXPECT_TRUE(std::isnan(search.unresolved_distance(found, 0.)));
      EXPECT_EQ(n_probes, n);
    }

    TEST(TransitionSearch, ReachesHighAccuracy)
    {
      int              n_probes = 0;
      TransitionSearch search(constriction(1.436, n_probes), 1e-9);
      EXPECT_LE(relative_width(search.enclose({1.25}, 0.)), 1e-9);
      // The sealed side begins so steeply that interpolation gains little.
      EXPECT_LE(n_probes, 28);
    }

    TEST(TransitionSearch, TakesFewSolvesWithinAGridSpacingOfClosing)
    {
      for (const double tolerance : {1e-4, 1e-6, 1e-9})
        {
          int              n_probes = 0;
          TransitionSearch search(
            [&](const double load) {
              ++n_probes;
              // Linear within a spacing of closing, with the same slope on both sides.
              constexpr double spacing = 1e-2;
              const double     open    = 1. - load / 1.436;
              const double     power   = open > 0 ? of_gap : of_pressure;
              const double     size    = std::abs(open) / spacing;
              Probe            result;
              result.openness = std::copysign(
                size < 1. ? size : 1. + (std::pow(size, power) - 1.) / power, open);
              return result;
            },
            tolerance);
          const EnclosingPair found = search.enclose({1.25}, 0.);
          EXPECT_LE(found.before, 1.436);
          EXPECT_GE(found.beyond, 1.436);
          EXPECT_LE(relative_width(found), tolerance);
          EXPECT_LE(n_probes, 20) << tolerance;
        }
    }

    TEST(TransitionSearch, TakesPartedWallsAndVerdictsWithoutSize)
    {
      for (const double sealed : {0., -1.})
        {
          int              n_probes = 0;
          TransitionSearch search(
            [&](const double load) {
              ++n_probes;
              Probe result;
              result.openness =
                load < 1.436 ? std::numeric_limits<double>::infinity() : sealed;
              return result;
            },
            1e-4);
          const EnclosingPair found = search.enclose({1.25}, 0.);
          EXPECT_LT(found.before, 1.436);
          EXPECT_GE(found.beyond, 1.436);
          EXPECT_LE(relative_width(found), 1e-4);
          EXPECT_LE(n_probes, 40);
        }
    }

    TEST(TransitionSearch, AnotherLevelUsesKnownLoads)
    {
      int                 n_probes = 0;
      TransitionSearch    search(constriction(1.436, n_probes), 1e-4);
      const EnclosingPair dry   = search.enclose({1.25}, 0.);
      const int           first = n_probes;
      const EnclosingPair slip  = search.enclose({1.25}, 2e-3);
      const double        exact = 1.436 * (1 - std::pow(2e-3 / .8, 1 / of_gap));
      EXPECT_LE(slip.before, exact);
      EXPECT_GE(slip.beyond, exact);
      EXPECT_LT(slip.beyond, dry.before);
      EXPECT_LE(n_probes - first, 8);
      const int second = n_probes;
      EXPECT_EQ(search.enclose({1.25}, 0.).before, dry.before);
      EXPECT_EQ(n_probes, second);
    }

    /** The same on points that become finer: the critical load is `coarse` until a load
     *  is asked for within a relative `near` of an earlier one, then it is `fine`. */
    class Growing
    {
    public:
      Growing(const double coarse, const double fine_, const double near_)
        : critical(coarse)
        , fine(fine_)
        , near(near_)
      {
      }

      Probe
      operator()(const double load)
      {
        for (const double other : asked)
          if (std::abs(load - other) <= near * load)
            critical = fine;
        asked.push_back(load);
        return constriction(critical, n_probes)(load);
      }

      int n_probes = 0;

    private:
      double              critical;
      const double        fine, near;
      std::vector<double> asked;
    };

    TEST(TransitionSearch, ForgetsAnswersThatAreContradicted)
    {
      const double tolerance = 1e-6;
      // The critical load on the finer points lies on either side of the bracket on the
      // coarser ones, and far outside of it.
      for (const double fine : {1.41, 1.436 - 1e-5, 1.436 + 1e-5, 1.45})
        {
          Growing             contact(1.436, fine, 2 * tolerance);
          TransitionSearch    search([&](const double load) { return contact(load); },
                                  tolerance);
          const EnclosingPair found = search.enclose_surely({1.25}, 0.);
          EXPECT_LE(found.before, fine);
          EXPECT_GT(found.beyond, fine);
          EXPECT_GT(found.beyond, found.before);
          EXPECT_LE(relative_width(found), tolerance);
          EXPECT_LE(contact.n_probes, 80) << fine;
          // The last answers are those of the finer points.
          for (const double end : {found.before, found.beyond})
            {
              int        n        = 0;
              const auto expected = constriction(fine, n)(end).openness;
              EXPECT_EQ(search.at(end).openness, expected);
            }
        }
    }

    TEST(TransitionSearch, AsksBothEndsOnceMoreWhereNothingIsContradicted)
    {
      int                 n_plain = 0, n_sure = 0;
      TransitionSearch    plain(constriction(1.436, n_plain), 1e-4);
      TransitionSearch    sure(constriction(1.436, n_sure), 1e-4);
      const EnclosingPair one   = plain.enclose({1.25}, 0.);
      const EnclosingPair other = sure.enclose_surely({1.25}, 0.);
      EXPECT_EQ(one.before, other.before);
      EXPECT_EQ(one.beyond, other.beyond);
      EXPECT_EQ(n_sure, n_plain + 2);
    }

    TEST(TransitionSearch, SaysWhenThereIsNone)
    {
      const auto always = [](const double value) {
        return [value](double) {
          Probe result;
          result.openness = value;
          return result;
        };
      };
      const auto expect = [&](const double       openness,
                              const SearchStart &first,
                              const std::string &sentence) {
        try
          {
            TransitionSearch(always(openness), 1e-4).enclose(first, 0.);
            ADD_FAILURE() << sentence;
          }
        catch (const ComputationError &error)
          {
            EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos)
              << error.what();
          }
      };
      expect(1., {1.}, "still leaks at");
      expect(-1., {1.}, "is still sealed at");
      // Where a search may not go beyond its first value, another one helps.
      expect(1., {1., .2, 1.}, "still leaks at 1; begin Load programme/Pressures with a");
      expect(1., {1., .2, 2.}, "; switch the search off");
    }
  } // namespace
} // namespace strait
