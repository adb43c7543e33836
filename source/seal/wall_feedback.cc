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
    // Half as many leave directions out in which the gap and the fluid pull each other
    // along, which takes more rounds; twice as many take twice the memory, for rounds
    // from places where the map was another one.
    constexpr int rounds_combined = 6;

    // Rounds of one map; see the class. Half as many give combinations up that would
    // still have paid, twice as many lose as many rounds where none does.
    constexpr int last_combined = 30;

    // So often the verdict may change before the two sides are enclosed. Half as often,
    // sides are halved where the iteration would have settled on one; twice as often,
    // rounds are spent on jumping to and fro.
    constexpr int changes_allowed = 3;

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

    SlabField
    difference(SlabField from, const SlabField &field)
    {
      return moved(std::move(from), -1., field);
    }

    /** Replace @p a by its mixture with @p b that is smallest. Returns the share of b. */
    double
    mix_towards_zero(SlabField &a, const SlabField &b)
    {
      const SlabField way    = difference(b, a);
      const double    square = product(way, way);
      const double    share =
        square > 0 ? std::clamp(-product(a, way) / square, 0., 1.) : 0.;
      a = moved(std::move(a), share, way);
      return share;
    }
  } // namespace

  WallFeedback::WallFeedback(const FeedbackParameters &feedback_parameters,
                             const SlabLayoutPtr      &layout)
    : parameters(feedback_parameters)
    , assumed(layout)
    , fixed_point(layout->communicator(),
                  parameters.plain_rounds ? 0 : rounds_combined,
                  parameters.relaxation)
  {
  }

  FeedbackResult
  WallFeedback::solve(const Round        &round,
                      const double        largest_pressure,
                      const FeedbackGoal &goal)
  {
    FeedbackResult      result;
    int                 changes_of_verdict = 0;
    int                 rounds_of_map      = 0; // since it has jumped
    std::optional<bool> percolated;             // in the round before
    const auto          begin_again = [&](const double relaxation) {
      fixed_point.restart(relaxation);
      walk          = Walk();
      rounds_of_map = 0;
    };
    if (goal.goes_on && !last_image.empty())
      {
        propose(last_image, 0, goal);
        fixed_point.move_on(parameters.relaxation);
      }
    else
      {
        fixed_point.restart(parameters.relaxation);
        last_leak_rate = 0;
      }
    last_image = SlabField();
    walk       = Walk();
    while (result.iterations < parameters.maximum_iterations)
      {
        FeedbackRound now = round(assumed);
        ++result.iterations;
        ++rounds_of_map;
        // Trapped fluid may have a higher pressure than the reservoirs.
        scale         = std::max(largest_pressure, root_mean_square(now.fluid_pressure));
        result.change = size(difference(now.fluid_pressure, assumed));
        result.leak_change =
          now.leak_rate > 0 ? std::abs(last_leak_rate / now.leak_rate - 1.) : 0.;
        const bool flips = percolated && *percolated != now.percolates;
        const bool agrees =
          result.agrees_within(goal) ||
          (now.percolates && std::max(result.change, result.leak_change) <=
                               parameters.relaxation * goal.once_open);
        if (agrees || (!flips && rounds_of_map >= last_combined &&
                       stays_in_place(now, goal, result)))
          {
            result.converged = true;
            last_image       = agrees ? std::move(now.fluid_pressure) : assumed;
            return result;
          }
        if (flips)
          {
            begin_again(.5 * fixed_point.relaxation());
            ++changes_of_verdict;
          }
        percolated                                 = now.percolates;
        last_leak_rate                             = now.leak_rate;
        (now.percolates ? open_side : closed_side) = assumed;
        if (changes_of_verdict <= changes_allowed)
          propose(now.fluid_pressure, rounds_of_map, goal);
        else if (slide(round, goal, result))
          return result;
        else
          {
            changes_of_verdict = 0;
            percolated.reset();
            begin_again(parameters.relaxation);
          }
      }
    return result;
  }

  void
  WallFeedback::propose(const SlabField &image, const int round, const FeedbackGoal &goal)
  {
    const bool combines = round < last_combined;
    fixed_point.advance(assumed.data(), image.data(), assumed.size(), combines);
    if (combines && mean(assumed) >= goal.largest_mean)
      {
        assumed = image;
        fixed_point.restart(fixed_point.relaxation());
      }
  }

  /** Whether the rounds of relaxation stay within the tolerance of one place, where a
   *  mixture of their changes is none. */
  bool
  WallFeedback::stays_in_place(const FeedbackRound &now,
                               const FeedbackGoal  &goal,
                               FeedbackResult      &result)
  {
    SlabField    change = difference(now.fluid_pressure, assumed);
    const double leak_change =
      walk.leak_rate > 0 ? std::abs(now.leak_rate / walk.leak_rate - 1.) : 0.;
    if (walk.start.empty() || leak_change > goal.leak_tolerance ||
        size(difference(assumed, walk.start)) > goal.tolerance)
      {
        walk = {assumed, std::move(change), now.leak_rate};
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

  /**
   * Between a pressure that leaves the channel open and one that closes it. Where these
   * are one within the tolerance the fluid changes as a mixture of what follows from
   * either: the one that changes least (Filippov's, for differential equations). Go that
   * way along the jump, until the mixture changes nothing and there is no state, or until
   * it leads away: then returns false, and the iteration is to go on from what is
   * assumed.
   */
  bool
  WallFeedback::slide(const Round        &round,
                      const FeedbackGoal &goal,
                      FeedbackResult     &result)
  {
    SlabField  on_open, on_closed; // changes on either side
    const auto may_ask = [&]() {
      return !result.converged && result.iterations < parameters.maximum_iterations;
    };
    const auto is_open = [&](SlabField side) {
      assumed           = std::move(side);
      FeedbackRound now = round(assumed);
      ++result.iterations;
      SlabField change = difference(std::move(now.fluid_pressure), assumed);
      result.change    = size(change);
      result.converged = result.change <= goal.tolerance;
      (now.percolates ? open_side : closed_side) = assumed;
      (now.percolates ? on_open : on_closed)     = std::move(change);
      return now.percolates;
    };
    while (may_ask())
      {
        if (const SlabField apart = difference(closed_side, open_side);
            size(apart) > goal.tolerance)
          {
            is_open(moved(open_side, .5, apart));
            continue;
          }
        if (on_closed.empty() || on_open.empty())
          {
            is_open(on_closed.empty() ? closed_side : open_side);
            continue;
          }
        SlabField    change = on_open;
        const double share  = mix_towards_zero(change, on_closed);
        result.change       = size(change);
        result.undecided    = result.change <= goal.tolerance;
        result.open_share   = result.undecided ? 1. - share : 1.;
        if (result.undecided)
          {
            is_open(open_side);
            result.converged = false;
            return true;
          }
        if (share == 0. || share == 1.)
          {
            assumed = moved(share == 0. ? open_side : closed_side, 1., change);
            return false;
          }
        const SlabField open   = moved(open_side, 1., change);
        const bool      opens  = is_open(moved(closed_side, 1., change));
        const bool      closes = may_ask() && !is_open(open);
        if (opens != closes && may_ask())
          {
            // Both are on one side. What follows from there leads to the other one.
            const SlabField side = opens ? open_side : closed_side;
            const SlabField way  = opens ? on_open : on_closed;
            double          part = goal.tolerance / size(way);
            while (may_ask() && part < 1. && is_open(moved(side, part, way)) == opens)
              part *= 2;
            if (part >= 1.)
              {
                assumed = moved(side, 1., way);
                return false;
              }
          }
      }
    return true;
  }

  double
  WallFeedback::size(const SlabField &change) const
  {
    const double of_all = root_mean_square(change);
    return of_all > 0 ? of_all / scale : 0.;
  }
} // namespace strait
