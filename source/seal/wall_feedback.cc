// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/seal/wall_feedback.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace strait
{
  namespace
  {
    // Half as many leave out directions in which gap and fluid amplify each other, which
    // takes more rounds; twice as many take twice the memory, for rounds from places
    // where the map was another one.
    constexpr int rounds_combined = 6;

    // Rounds; see the class. Half as many give up combinations that would still pay;
    // twice as many lose as many rounds where none does.
    constexpr int last_combined = 30;

    // How often rounds of relaxation open a closed channel before this counts as a cycle.
    // With half as many, channels are said to leak that close in the end; twice as many
    // take twice the rounds, more than there are where cycles are long.
    constexpr int openings_of_cycle = 3;

    double
    root_mean_square(const SlabField &field)
    {
      return std::sqrt(product(field, field) /
                       static_cast<double>(field.grid().n_points()));
    }

    /** @p from + @p factor · @p change. */
    SlabField
    moved(SlabField from, const double factor, const SlabField &change)
    {
      for (std::size_t i = 0; i < from.size(); ++i)
        from[i] += factor * change[i];
      return from;
    }

    /** The difference of two leak rates relative to the larger one. */
    double
    relative_difference(const double a, const double b)
    {
      return a == b ? 0. : std::abs(a - b) / std::max(a, b);
    }

    SlabField
    difference(SlabField from, const SlabField &field)
    {
      return moved(std::move(from), -1., field);
    }

    /** Replace @p a by its smallest mixture with @p b. */
    void
    mix_towards_zero(SlabField &a, const SlabField &b)
    {
      const SlabField way    = difference(b, a);
      const double    square = product(way, way);
      const double    fraction =
        square > 0 ? std::clamp(-product(a, way) / square, 0., 1.) : 0.;
      a = moved(std::move(a), fraction, way);
    }
  } // namespace

  WallFeedback::WallFeedback(const FeedbackParameters &feedback_parameters,
                             const SlabLayoutPtr      &layout,
                             const double              fraction)
    : parameters(feedback_parameters)
    , assumed(layout)
    , fixed_point([layout](const auto &a,
                           const auto &b) { return product(*layout, a, b); },
                  parameters.plain_rounds ? 0 : rounds_combined,
                  fraction * parameters.relaxation)
  {
  }

  FeedbackResult
  WallFeedback::solve(const Round        &round,
                      const double        largest_pressure,
                      const FeedbackGoal &goal)
  {
    FeedbackResult      result;
    std::optional<bool> percolated; // in the round before
    int                 openings = 0;
    if (goal.continues && !last_image.empty())
      {
        propose(last_image, true, goal);
        fixed_point.move_on();
      }
    else
      {
        fixed_point.restart();
        last_leak_rate = 0;
      }
    last_image = SlabField();
    walk       = Walk();
    while (result.iterations < parameters.maximum_iterations)
      {
        FeedbackRound now      = round(assumed);
        const bool    combines = ++result.iterations < last_combined || goal.verdict;
        if (goal.verdict && now.percolates != *goal.verdict)
          return result;
        // Trapped fluid may have a higher pressure than the reservoirs.
        scale = std::max(largest_pressure, root_mean_square(now.fluid_pressure));
        SlabField change   = difference(now.fluid_pressure, assumed);
        result.change      = size(change);
        result.leak_change = relative_difference(now.leak_rate, last_leak_rate);
        const bool agrees =
          result.agrees_within(goal) ||
          (now.percolates && std::max(result.change, result.leak_change) <=
                               parameters.relaxation * goal.once_open);
        if (percolated && *percolated != now.percolates)
          {
            fixed_point.jump();
            walk = Walk();
            if (now.percolates && !combines)
              ++openings;
          }
        if (agrees ||
            stays_in_place(std::move(change), now.leak_rate, goal, combines, result) ||
            (openings == openings_of_cycle && goal.asks_verdict_only()))
          {
            result.converged = true;
            last_image       = agrees ? std::move(now.fluid_pressure) : assumed;
            return result;
          }
        percolated     = now.percolates;
        last_leak_rate = now.leak_rate;
        propose(now.fluid_pressure, combines, goal);
      }
    return result;
  }

  void
  WallFeedback::propose(const SlabField    &image,
                        const bool          combines,
                        const FeedbackGoal &goal)
  {
    fixed_point.advance(assumed.data(), image.data(), assumed.size(), combines);
    if (combines && mean(assumed) >= goal.largest_mean)
      {
        assumed = image;
        fixed_point.restart();
      }
  }

  /** Whether the rounds stay within the tolerance of one place, and a mixture of their
   *  changes vanishes within it. The last round has made this @p change. */
  bool
  WallFeedback::stays_in_place(SlabField           change,
                               const double        leak_rate,
                               const FeedbackGoal &goal,
                               const bool          combines,
                               FeedbackResult     &result)
  {
    walk.least_leak = std::min(walk.least_leak, leak_rate);
    walk.most_leak  = std::max(walk.most_leak, leak_rate);
    // Relative to the smaller one: this far from either rate reaches the other.
    const double leak_change =
      walk.most_leak > walk.least_leak ? walk.most_leak / walk.least_leak - 1. : 0.;
    // While rounds are combined, or the pressure creeps, the leak rate may still settle;
    // otherwise it differs on the two sides of the place.
    const bool still_settles =
      leak_change > goal.leak_tolerance && (combines || result.change <= goal.tolerance);
    if (walk.start.empty() || still_settles ||
        size(difference(assumed, walk.start)) > goal.tolerance)
      {
        walk = {assumed, std::move(change), leak_rate, leak_rate};
        return false;
      }
    mix_towards_zero(walk.mixture, change);
    const double smallest = size(walk.mixture);
    if (smallest > goal.tolerance)
      return false;
    result.change      = smallest;
    result.leak_change = leak_change;
    return true;
  }

  double
  WallFeedback::size(const SlabField &change) const
  {
    const double of_all = root_mean_square(change);
    return of_all > 0 ? of_all / scale : 0.;
  }
} // namespace strait
