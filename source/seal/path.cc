// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/path.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** Of one step: a rough contact line may move in many small jumps, which together
     *  are not worth more. With half of it such a step ends with one wider jump where
     *  twice as many solves would enclose them one by one. */
    constexpr int max_solves = 60;

    /** Of a step in which fluid is cut off, of the one asked for. Half of it takes twice
     *  as many where small pools form all the time, double of it leaves twice the doubt.
     */
    constexpr double shortest = 1.5 / 16;

    bool
    has_energy(const SealState &state)
    {
      return state.contact && state.contact->adhesion && !state.fluid;
    }

    bool
    has_detached(const SealState &state)
    {
      return state.contact && state.contact->adhesion &&
             state.contact->adhesion->detached;
    }

    double
    slope_of_first(const SealState &state, const ContactControl control)
    {
      return std::abs(control == ContactControl::load ? state.contact->mean_gap
                                                      : state.contact->nominal_pressure);
    }

    /** Whether too much of the load in @p state hangs on when fluid was cut off. */
    bool
    cuts_off_unseen(const SealState &state, const double tolerance)
    {
      return state.fluid && state.fluid->trapped &&
             state.fluid->trapped->uncertainty >
               tolerance * std::abs(state.contact->nominal_pressure);
    }

    /** Along a path. */
    double
    distance(const Control &a, const Control &b)
    {
      return std::abs(a.target - b.target) +
             std::abs(a.inlet_pressure - b.inlet_pressure);
    }

    /** What adds up over the steps on the way to a state. */
    struct Sums
    {
      long   fft_pairs       = 0;
      int    iterations      = 0;
      int    rounds          = 0;
      double contact_seconds = 0.;
      double uncertainty     = 0.; // of steps that are taken

      void
      add_costs(const SealState &state)
      {
        contact_seconds += state.contact_seconds;
        fft_pairs += state.contact ? state.contact->fft_pairs : 0;
        iterations += state.contact ? state.contact->iterations : 0;
        rounds += state.fluid ? state.fluid->rounds : 0;
      }

      void
      add_uncertainty(const SealState &state)
      {
        if (state.fluid && state.fluid->trapped)
          uncertainty += state.fluid->trapped->uncertainty;
      }

      void
      put_into(SealState &state) const
      {
        state.contact_seconds = contact_seconds;
        if (state.contact)
          {
            state.contact->fft_pairs  = fft_pairs;
            state.contact->iterations = iterations;
          }
        if (state.fluid)
          state.fluid->rounds = rounds;
        if (state.fluid && state.fluid->trapped)
          state.fluid->trapped->uncertainty = uncertainty;
      }
    };

    /**
     * Whether the step @p from one state @p to another passes a jump and may be halved.
     * If it passes one and is short enough, or is the last of @p n_solves, the jump is
     * one of @p jumps.
     */
    bool
    leaps(const SealState   &from,
          SealState         &to,
          const StepRule    &rule,
          int               &n_solves,
          std::vector<Jump> &jumps)
    {
      if (!has_energy(to))
        return false;
      const Stride stride(from, to, rule.control);
      const bool   detached = has_detached(to), halves = rule.jump_tolerance > 0;
      if (detached || (halves && !stride.is_smooth()))
        {
          if (halves && ++n_solves < max_solves &&
              std::abs(to.control.target - from.control.target) > rule.jump_tolerance)
            return true;
          if (detached)
            jumps.push_back(stride.pull_off());
          else if (const auto jump = stride.jump())
            jumps.push_back(*jump);
        }
      to.trend = stride.trend_after();
      return false;
    }

    Control
    halfway(const Control &a, const Control &b)
    {
      return {.5 * (a.target + b.target),
              .5 * (a.inlet_pressure + b.inlet_pressure),
              .5 * (a.slip_length + b.slip_length)};
    }
  } // namespace

  Arrival
  follow(SealModel       &model,
         const Control   &to,
         const SealState *from,
         const Aim        aim,
         const StepRule  &rule)
  {
    Arrival              arrival;
    std::vector<Control> ahead = {to};
    Sums                 sums;
    int                  n_solves = 0;
    while (!ahead.empty())
      {
        const SealState *here  = arrival.state ? &*arrival.state : from;
        SealState        state = model.solve(ahead.back(), here, aim);
        sums.add_costs(state);
        if (here != nullptr)
          {
            const bool is_long = distance(here->control, ahead.back()) >
                                 shortest * distance(from->control, to);
            if ((is_long && cuts_off_unseen(state, rule.trapped_tolerance)) ||
                leaps(*here, state, rule, n_solves, arrival.jumps))
              {
                ahead.push_back(halfway(ahead.back(), here->control));
                continue;
              }
          }
        else if (has_energy(state))
          state.trend.largest_slope = slope_of_first(state, rule.control);
        if (has_detached(state))
          {
            arrival.state.reset();
            return arrival;
          }
        sums.add_uncertainty(state);
        arrival.state = std::move(state);
        ahead.pop_back();
      }
    sums.put_into(*arrival.state);
    return arrival;
  }
} // namespace strait
