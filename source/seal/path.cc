// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/gap_optimisation.h>
#include <strait/seal/path.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** Largest number of solves for one step: a rough contact line may move in many small
     *  jumps, which together are not worth more. With half of it, such a step ends with
     *  one wide jump; double of it would enclose those jumps one by one. */
    constexpr int max_solves = 60;

    /** Fraction of the step asked for below which a step is not halved, even if fluid is
     *  cut off or a channel opens or closes in it. Half of it takes twice as many steps
     *  where small regions form all the time; double of it leaves twice the doubt. */
    constexpr double shortest = 1.5 / 16;

    // How many times faster than in the last step the mean gap (or, under gap control,
    // the pressure) may change. Half of it halves steps that are smooth, which costs
    // contact problems; double of it overlooks jumps that change the gap by that little.
    constexpr double steeper = 1.3;

    /** Largest deviation of the energy's change from the trapezoidal rule, in units of
     *  the range that the slopes at the ends allow. It is a twelfth of the relative step
     *  on a smooth path, and |f − 1/2| for a jump at a fraction f of the step. Half of it
     *  halves steps that are only long; double of it overlooks more jumps near the
     *  middle. */
    constexpr double largest_skewness = .025;

    /** Least energy that a jump must dissipate, in units of the largest slope times the
     *  step; and the change of the slope that is always allowed, in units of the largest.
     *  Half of it mistakes the optimiser's tolerance for jumps sooner; double of it
     *  overlooks jumps that dissipate so little. */
    constexpr double slope_noise = 1e-3;

    PathPoint
    point_of(const SealState &state)
    {
      const ContactState &contact = *state.contact;
      return {state.control.target,
              contact.nominal_pressure,
              contact.mean_gap,
              contact.contact_area,
              contact.adhesion->total_energy,
              contact.adhesion->detached};
    }

    /** The derivative of the energy by what is prescribed; see follow(). */
    double
    slope_of_energy(const PathPoint &point, const ContactControl control)
    {
      return control == ContactControl::load ? point.mean_gap : -point.pressure;
    }

    /** One step of a path whose states have an energy; see follow(). */
    struct Stride
    {
      bool leaps; // the surfaces part, or jumps are sought and it may be one
      std::optional<Jump> jump;  // what a leap that can be no shorter may be
      PathTrend           trend; // how the path goes on if it is smooth
    };

    /** The step of an adhesive contact @p from one state to the point @p after. */
    Stride
    stride_to(const SealState &from, const PathPoint &after, const StepRule &rule)
    {
      const PathPoint  before       = point_of(from);
      const PathTrend &trend        = from.trend;
      const double     slope_before = slope_of_energy(before, rule.control);
      const double     slope_after  = slope_of_energy(after, rule.control);
      const double     change       = after.target - before.target;
      const double     rise         = after.energy - before.energy;
      const double     steepening   = slope_after - slope_before;
      const double     rounding =
        energy_noise * std::max(std::abs(before.energy), std::abs(after.energy));
      // Take the largest slope of the path before: this state may be beyond a jump.
      const double noise =
        slope_noise * trend.largest_slope * std::abs(change) + rounding;
      // The change of the energy without dissipation, by the slope at either end.
      const auto [least, most] =
        std::minmax({slope_before * change, slope_after * change});
      const double middle = .5 * (least + most);
      const bool   is_steep =
        rise < least - noise ||
        std::abs(rise - middle) > largest_skewness * (most - least) + noise;
      const bool is_as_before =
        !trend.is_known ||
        std::abs(steepening) <=
          slope_noise * trend.largest_slope + steeper * std::abs(trend.slope * change);
      Stride stride = {after.detached ||
                         (rule.jump_tolerance > 0 && (is_steep || !is_as_before)),
                       {},
                       trend};
      if (after.detached) // there is no state for the energy to fall to
        stride.jump = Jump{before, after, std::nan("")};
      else if (stride.leaps && !(rise >= least - rounding)) // and not merely steep
        // The load of the jump is unknown within the step: take the mean of the slopes.
        stride.jump = Jump{before, after, middle - rise};
      stride.trend.largest_slope = std::max(trend.largest_slope, std::abs(slope_after));
      if (change != 0)
        {
          stride.trend.is_known = true;
          stride.trend.slope    = steepening / change;
        }
      return stride;
    }

    bool
    has_energy(const SealState &state)
    {
      return state.contact && state.contact->adhesion && !state.fluid;
    }

    /** Whether too much of the load in @p state depends on when fluid was cut off. */
    bool
    cuts_off_unseen(const SealState &state, const double tolerance)
    {
      return state.fluid && state.fluid->trapped &&
             state.fluid->trapped->uncertainty >
               tolerance * std::abs(state.contact->nominal_pressure);
    }

    /** The distance of two controls along a path. */
    double
    distance(const Control &a, const Control &b)
    {
      return std::abs(a.target - b.target) +
             std::abs(a.inlet_pressure - b.inlet_pressure);
    }

    /** A control on the way, and what was found there from an earlier state. */
    struct Stop
    {
      Control                  control;
      std::optional<PathPoint> seen = {};
    };

    /** Whether a jump between @p from and @p stop is known and not yet enclosed. What was
     *  seen at the stop from an earlier state saves solving for one to be discarded. */
    bool
    is_open(const SealState &from, const Stop &stop, const StepRule &rule)
    {
      return stop.seen && rule.jump_tolerance > 0 &&
             std::abs(stop.control.target - from.control.target) > rule.jump_tolerance &&
             stride_to(from, *stop.seen, rule).leaps;
    }

    Control
    halfway(const Control &a, const Control &b)
    {
      return {.5 * (a.target + b.target),
              .5 * (a.inlet_pressure + b.inlet_pressure),
              .5 * (a.slip_length + b.slip_length)};
    }
  } // namespace

  std::string
  describe(const Jump &jump)
  {
    if (jump.is_pull_off())
      return format("the surfaces part between the nominal pressures %.6g and %.6g",
                    jump.before.target,
                    jump.after.target);
    return format(
      "jump between %.6g and %.6g: contact %.3f %% to %.3f %%, %.4g "
      "dissipated per area",
      jump.before.target,
      jump.after.target,
      100 * jump.before.contact_area,
      100 * jump.after.contact_area,
      jump.dissipated);
  }

  Arrival
  follow(const SealModel &model,
         const Control   &to,
         const SealState *from,
         const Aim        aim,
         const StepRule  &rule)
  {
    Arrival           arrival;
    std::vector<Stop> ahead = {{to}};
    Costs             spent;
    double            uncertainty = 0.; // of the steps taken so far
    int               n_solves    = 0;
    while (!ahead.empty())
      {
        const SealState *here = arrival.state ? &*arrival.state : from;
        if (here != nullptr && n_solves < max_solves &&
            is_open(*here, ahead.back(), rule))
          ahead.push_back({halfway(ahead.back().control, here->control)});
        bool      changes = false; // whether a channel opens or closes in this step
        Stop     &next    = ahead.back();
        SealState state =
          model(next.control, here, ahead.size() > 1 ? Aim::verdict : aim);
        ++n_solves;
        state.costs += spent;
        spent = state.costs;
        if (has_energy(state))
          next.seen = point_of(state);
        if (here != nullptr)
          {
            if (n_solves < max_solves && is_open(*here, next, rule))
              continue;
            const bool is_long = distance(here->control, next.control) >
                                 shortest * distance(from->control, to);
            changes = changes_verdict(*here, state);
            if (is_long && (changes || cuts_off_unseen(state, rule.trapped_tolerance)))
              {
                ahead.push_back({halfway(next.control, here->control)});
                continue;
              }
            if (next.seen)
              {
                const Stride stride = stride_to(*here, *next.seen, rule);
                state.trend         = stride.trend;
                if (stride.jump)
                  arrival.jumps.push_back(*stride.jump);
              }
          }
        else if (next.seen)
          state.trend.largest_slope = std::abs(slope_of_energy(*next.seen, rule.control));
        if (state.contact && state.contact->has_detached())
          {
            arrival.state.reset();
            return arrival;
          }
        if (state.fluid && state.fluid->trapped)
          {
            uncertainty += state.fluid->trapped->uncertainty;
            state.fluid->trapped->uncertainty = uncertainty;
          }
        arrival.state = std::move(state);
        ahead.pop_back();
        if (changes && ahead.size() > 1) // beyond the change, a step may be long again
          ahead.erase(ahead.begin() + 1, ahead.end());
      }
    return arrival;
  }
} // namespace strait
