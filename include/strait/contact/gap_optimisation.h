// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/contact_state.h>
#include <strait/contact/half_space_problem.h>

#include <vector>

namespace strait
{
  /** What is prescribed while the gap g >= 0 is sought: its mean or the nominal pressure
   *  p0, which may be negative. */
  struct GapConstraint
  {
    bool   fixes_mean_gap;
    double value;
  };

  /** Where an optimiser stopped. */
  struct GapSolution : ContactSolution
  {
    double        nominal_pressure = 0;
    AdhesiveState adhesion; // without smallest_curvature and softest_direction
  };

  /** Relative rise of the energy that rounding may cause in a downhill step. Half of it
   *  may reject such steps near the end, double of it admits steps that gain nothing. */
  constexpr double energy_noise = 3e-13;

  /**
   * A method that goes downhill in energy from a given gap g >= 0 to a stationary one. It
   * stops there, when the surfaces part, when it gains nothing more, or after too many
   * iterations. Methods differ in the single iteration. This class computes what follows
   * from the gap: the elastic traction K w with w = g + h, the derivative r of the energy
   * with respect to g, and the curvature of the adhesion.
   */
  class GapOptimiser
  {
  public:
    GapOptimiser(GapProblem             &problem,
                 const GapConstraint    &constraint,
                 const ContactTolerance &tolerance);

    virtual ~GapOptimiser() = default;

    /**
     * Find a stationary gap. @p gap_values is a start on entry, where negative values
     * count as 0, and the solution on return, exactly 0 in contact. The residual is the
     * larger of max |r| over open points and max −r over points in contact, in units of
     * the tolerance's traction, where r is the derivative of the energy. Collective.
     */
    GapSolution solve(double *gap_values);

    /** The derivative r of the energy at the solution, which in contact is the reaction
     *  of the wall. The array lives as long as this object. */
    const double *
    reaction() const
    {
      return derivative.data();
    }

    /**
     * Estimate the smallest eigenvalue μ of (K + γ'') v = μ (K + mean_stiffness() ⟨·⟩) v
     * on the open points; the others are held by the wall. All v have the mean 0 if that
     * of the gap is fixed. A minimum of the energy has μ > 0; always μ <= 1.
     *
     * Preconditioned conjugate gradients lower the Rayleigh quotient, each time to its
     * minimum along a line. The quotient bounds μ from above, so that a negative one
     * proves that the gap is not a minimum.
     *
     * The solution is that of the last solve(), whose gap must not have been changed
     * since. @p v is a start on entry, replaced by noise if it is empty on all ranks, and
     * the eigenvector found on return. Needs five fields, @p v included. Collective.
     */
    double smallest_curvature(std::vector<double> &v);

  protected:
    /** Discard what was learned from an earlier solve(). */
    virtual void
    begin()
    {
    }

    /** Do one iteration from the present gap, whose residual is @p residual. Return false
     *  if it finds no step that lowers the energy. Collective. */
    virtual bool descend(double residual) = 0;

    /** A field of zeros. */
    std::vector<double>
    field() const
    {
      return std::vector<double>(problem.size);
    }

    /** Recompute all that follows from the gap, after a change other than by move(). One
     *  application of K; collective. */
    void refresh();

    /**
     * Step g += length·d along the @p direction d. The @p response is K d, and @p work is
     * <d, Kd>. Values that are 0 but for rounding become 0. Collective.
     */
    void
    move(const double *direction, const double *response, double work, double length);

    /** Set negative values to 0 and, if the mean gap is fixed, scale the others to it.
     *  Collective. */
    void make_admissible(double *values) const;

    /** Set @p values to 0 except on the free points; if the mean gap is fixed, subtract
     *  their mean there. Collective. */
    void project_on_free(double *values) const;

    /** Replace @p z by M z on the free points and by 0 elsewhere. Collective. */
    void precondition(double *z);

    /** Whether point @p i may move: it is open, or in contact but pulled away. */
    bool
    is_free(const std::size_t i) const
    {
      return gap[i] > 0 || derivative[i] < 0;
    }

    double
    energy() const
    {
      return elastic_energy + adhesive_energy;
    }

    GapProblem         &problem;
    double             *gap         = nullptr;
    std::vector<double> elastic     = field(); // K w
    std::vector<double> derivative  = field(); // r = K w + γ'(g) + p0
    std::vector<double> curvature   = field(); // γ''(g)
    double              step_length = 0;       // of the last step, see RelaxationStep

  private:
    void evaluate();
    bool is_detached() const;

    const GapConstraint    constraint;
    const ContactTolerance tolerance;
    double                 pressure = 0; // p0; if sought, open points have the mean r = 0
    double elastic_energy           = 0; // ½⟨w, Kw⟩, and p0 ⟨g⟩ at fixed load
    double adhesive_energy          = 0;
    std::vector<std::uint8_t> closed; // scratch: marks of points that are not free
    double largest_violation = 0;     // of the conditions of a minimum [pressure]
    double smallest_gap      = 0;
  };
} // namespace strait
