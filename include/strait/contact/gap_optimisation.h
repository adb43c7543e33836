// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_optimisation_h
#define strait_contact_gap_optimisation_h

#include <strait/contact/contact_problem.h>
#include <strait/contact/contact_state.h>

#include <functional>

namespace strait
{
  /**
   * What is held while the gap g >= 0 is sought: the nominal pressure p0, which may
   * be negative, or the mean gap.
   */
  struct GapConstraint
  {
    /** Which of the two. */
    enum class Kind
    {
      nominal_pressure,
      mean_gap
    };

    Kind   kind;
    double value;

    bool
    fixes_mean_gap() const
    {
      return kind == Kind::mean_gap;
    }
  };

  /** When an optimiser stops. */
  struct GapTolerance
  {
    double residual;       // in units of `traction`
    double traction;       // of the surface's own scale
    int    max_iterations; // one for each direction that is followed
  };

  /** Where an optimiser stopped. */
  struct GapSolution
  {
    /**
     * The larger of max |r| over open points and max −r over points in contact, in
     * units of the tolerance's traction; r is the derivative of the energy.
     */
    double residual         = 0;
    double energy           = 0; // the problem's, without p0 ⟨g⟩ at fixed mean gap
    double adhesive_energy  = 0; // ⟨γ(g)⟩
    double nominal_pressure = 0;
    int    iterations       = 0;
    bool   converged        = false;
    bool   detached         = false; // see AdhesiveState
  };

  /** Is told of every iteration. */
  using RelaxationObserver = std::function<void(const RelaxationStep &)>;

  /** A method that goes down in energy from a given gap to a stationary one. */
  class GapOptimiser
  {
  public:
    virtual ~GapOptimiser() = default;

    /**
     * @p gap: a start on entry (negative values count as 0), the solution on return;
     * exactly 0 in contact. Collective.
     */
    virtual GapSolution solve(double *gap) = 0;

    /** The derivative r of the energy at the solution: the reaction of the wall in
     *  contact. Valid as long as this object. */
    virtual const double *reaction() const = 0;

    /** γ'' at the solution. Likewise. */
    virtual const double *curvature() const = 0;

    /** Bytes on this rank, beside the gap. */
    virtual std::size_t memory_consumption() const = 0;
  };
} // namespace strait

#endif
