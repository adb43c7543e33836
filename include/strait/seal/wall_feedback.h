// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>
#include <strait/seal/fixed_point.h>
#include <strait/spectral/slab_field.h>

#include <functional>
#include <limits>
#include <optional>

namespace strait
{
  /** What one round of contact and flow makes of an assumed fluid pressure. */
  struct FeedbackRound
  {
    bool      percolates = false; // in the gap under the assumed pressure
    double    leak_rate  = 0.;    // likewise
    SlabField fluid_pressure;     // that follows from this gap
  };

  /** How far to iterate. */
  struct FeedbackGoal
  {
    double tolerance;       // of the change of the fluid pressure, as FeedbackParameters'
    double leak_tolerance;  // of that of the leak rate, relative; infinite: any will do
    bool   goes_on = false; // the iteration before, with a map that has changed a little

    /** The same for both changes of plain rounds while the channel is open, if that is
     * all one wants to know; else 0. */
    double once_open = 0.;

    /** Whether the channel has to percolate, if only such a state or only one without is
     * wanted: the first round with another verdict is the last one. */
    std::optional<bool> verdict = {};

    /** No guess may have a larger mean pressure, such as the load. */
    double largest_mean = std::numeric_limits<double>::infinity();

    /** Whether it is enough to know if the channel leaks. */
    bool
    asks_verdict_only() const
    {
      return leak_tolerance == std::numeric_limits<double>::infinity();
    }
  };

  /** How the iteration ended. */
  struct FeedbackResult
  {
    int    iterations = 0;  // rounds
    double change     = 0;  // of the fluid pressure in the last round, see Tolerance;
                            // where a gap stays ajar of a mixture of the last rounds
    double leak_change = 0; // of the leak rate in these, relative
    bool   converged   = false;

    /** Whether these changes are as small as that. */
    bool
    agrees_within(const FeedbackGoal &goal) const
    {
      return change <= goal.tolerance && leak_change <= goal.leak_tolerance;
    }
  };

  /**
   * Finds the fluid pressure that contact and flow agree on: that under which the gap
   * is such that the fluid has this pressure.
   *
   * The first 30 rounds combine those before (FixedPoint), the next ones do not, unless
   * only one verdict is wanted. Where the verdict on percolation changes the map has
   * jumped: rounds begin again, with half the fraction. So steps become smaller where a
   * channel opens and closes or a gap is ajar, until they stay in one place
   * (stays_in_place()). Where they go in a circle instead, closed as long as the fluid
   * comes nearer and open until the pressure has fallen, no closed state is met on the
   * way: if only the verdict is asked for, the channel leaks.
   */
  class WallFeedback
  {
  public:
    using Round = std::function<FeedbackRound(const SlabField &assumed)>;

    /** @p fraction: of what relaxation takes of a change, the part that is taken. */
    WallFeedback(const FeedbackParameters &parameters,
                 const SlabLayoutPtr      &layout,
                 double                    fraction = 1.);

    /**
     * Iterate from pressure() on. The last call of @p round is for the pressure()
     * that is left. Changes are measured by @p largest_pressure, that of a reservoir or
     * the load, or by that of the fluid on the walls (rms) if that is more. Collective.
     */
    FeedbackResult
    solve(const Round &round, double largest_pressure, const FeedbackGoal &goal);

    /** The pressure that is assumed, on the grid; a start for solve(). */
    SlabField &
    pressure()
    {
      return assumed;
    }

  private:
    // What the rounds of relaxation did since one of them.
    struct Walk
    {
      SlabField start;   // assumed then; empty: it has not begun
      SlabField mixture; // of the changes, the smallest
      double    least_leak = 0;
      double    most_leak  = 0;
    };

    void   propose(const SlabField &image, bool combines, const FeedbackGoal &goal);
    bool   stays_in_place(SlabField           change,
                          double              leak_rate,
                          const FeedbackGoal &goal,
                          bool                combines,
                          FeedbackResult     &result);
    double size(const SlabField &change) const;

    const FeedbackParameters parameters;
    double                   scale = 1.;
    SlabField                assumed;
    FixedPoint               fixed_point;
    Walk                     walk;
    SlabField                last_image;         // of an iteration that has converged
    double                   last_leak_rate = 0; // 0: there was none
  };
} // namespace strait
