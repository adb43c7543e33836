// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_coupling_wall_feedback_h
#define strait_coupling_wall_feedback_h

#include <strait/base/feedback_parameters.h>
#include <strait/coupling/fixed_point.h>
#include <strait/spectral/slab_field.h>

#include <functional>

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
    bool leak_rate = true;  // until that has settled, too
    bool goes_on   = false; // the iteration before, with a map that has changed a little
  };

  /** How the iteration ended. */
  struct FeedbackResult
  {
    int    iterations = 0; // rounds
    double change     = 0; // of the fluid pressure in the last round, see Tolerance
    bool   converged  = false;

    /**
     * The channel is open without its own pressure and closed with it, or the other way
     * round, and no state between agrees with itself within the tolerance: it opens
     * and closes at this load.
     */
    bool undecided = false;
  };

  /**
   * Finds the fluid pressure that contact and flow agree on: that under which the gap
   * is such that the fluid has this pressure.
   *
   * While the iteration does not change the verdict on percolation it is accelerated.
   * Where it does, the map has jumped: it goes on more cautiously from where it is, and
   * after a few such changes it halves the distance between a pressure that leaves the
   * channel open and one that closes it, until they agree within the tolerance. The
   * last round is then one that leaves it open.
   */
  class WallFeedback
  {
  public:
    using Round = std::function<FeedbackRound(const SlabField &assumed)>;

    WallFeedback(const FeedbackParameters &parameters, const SlabLayoutPtr &layout);

    /**
     * Iterate from pressure() on. The last call of @p round is for the pressure()
     * that is left. @p largest_pressure, that of a reservoir, is the measure of
     * changes. Collective.
     */
    FeedbackResult
    solve(const Round &round, double largest_pressure, const FeedbackGoal &goal);

    /** The pressure that is assumed, on the grid; a start for solve(). */
    SlabField &
    pressure()
    {
      return assumed;
    }

    /** Bytes on this rank. */
    std::size_t memory_consumption() const;

  private:
    FeedbackResult bisect(const Round &round, FeedbackResult so_far);
    double         difference(const SlabField &a, const SlabField &b) const;

    const FeedbackParameters parameters;
    double                   scale = 1.;
    SlabField                assumed;
    FixedPoint               fixed_point;
    SlabField                open_side, closed_side; // the last with either verdict
  };
} // namespace strait

#endif
