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
  /** The result of one round of contact and flow under an assumed fluid pressure. */
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
    double leak_tolerance;  // of the relative change of the leak rate; infinite: any
    bool continues = false; // continue the iteration before, with a slightly changed map

    /** Tolerance of both changes, in units of the relaxation, that is enough while the
     *  channel is open, if that is all one wants to know; else 0. */
    double once_open = 0.;

    /** Whether the channel has to percolate, if only states with this verdict are wanted:
     *  the first round with the other one ends the iteration. */
    std::optional<bool> verdict = {};

    /** Limit of the mean pressure of a combination of rounds, such as the load. */
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
                            // of a mixture of rounds where a gap stays ajar
    double leak_change = 0; // of the leak rate in these rounds, relative
    bool   converged   = false;

    /** Whether both changes are within the tolerances of @p goal. */
    bool
    agrees_within(const FeedbackGoal &goal) const
    {
      return change <= goal.tolerance && leak_change <= goal.leak_tolerance;
    }
  };

  /**
   * Finds the fluid pressure on which contact and flow agree: the one that opens a gap in
   * which the fluid has this very pressure.
   *
   * The first 30 rounds combine the ones before (FixedPoint); later ones do not, unless
   * only one verdict is wanted. Where the verdict on percolation changes, the map has
   * jumped: earlier rounds are forgotten and the fraction is halved. Steps thus become
   * smaller where a channel opens and closes in turn, or where a gap stays ajar and
   * regulates its flow, until they stay in one place (stays_in_place()). Rounds may go in
   * a cycle instead: a closed channel fills until it opens, and stays open until the
   * pressure has fallen. As no closed state is met on the way, the channel leaks if only
   * the verdict is asked for.
   */
  class WallFeedback
  {
  public:
    using Round = std::function<FeedbackRound(const SlabField &assumed)>;

    /** @p fraction: factor of the relaxation in @p parameters. */
    WallFeedback(const FeedbackParameters &parameters,
                 const SlabLayoutPtr      &layout,
                 double                    fraction = 1.);

    /**
     * Iterate from pressure() on. Unless the rounds are used up, the last call of
     * @p round is for the pressure() that is left. Changes are relative to
     * @p largest_pressure, that of a reservoir or the load, or to the rms pressure of the
     * fluid on the walls if that is larger. Collective.
     */
    FeedbackResult
    solve(const Round &round, double largest_pressure, const FeedbackGoal &goal);

    /** The assumed pressure on the grid; the start of solve(). */
    SlabField &
    pressure()
    {
      return assumed;
    }

  private:
    // The rounds that have stayed in one place so far.
    struct Walk
    {
      SlabField start;   // assumed in the first one; empty: none yet
      SlabField mixture; // the smallest one of their changes
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
