// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/contact_state.h>
#include <strait/contact/half_space_problem.h>

#include <vector>

namespace strait
{
  /** What is held while the gap g >= 0 is sought: its mean or the nominal pressure p0,
   *  which may be negative. */
  struct GapConstraint
  {
    bool   fixes_mean_gap;
    double value;
  };

  /** Where an optimiser stopped. */
  struct GapSolution : ContactSolution
  {
    double        nominal_pressure = 0;
    AdhesiveState adhesion; // but for the curvature
  };

  /** Make @p values 0 where not is_free(i) and, if @p has_no_mean, of the mean 0 where it
   *  is. Collective. */
  template <class IsFree>
  void
  project(const ContactProblem &problem,
          const IsFree         &is_free,
          const bool            has_no_mean,
          double               *values)
  {
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      values[i] = is_free(i) ? values[i] : 0.;
    if (!has_no_mean)
      return;
    const auto [sum, area] = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      sums[0] += values[i];
      sums[1] += is_free(i) ? 1. : 0.;
    });
    const double mean      = area > 0 ? sum / area : 0.;
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      values[i] -= is_free(i) ? mean : 0.;
  }

  /** Of the energy: what rounding may add to it in a step downhill. Half of it may call a
   *  step uphill that is not, near the end; double of it admits steps that gain nothing.
   */
  constexpr double energy_noise = 3e-13;

  /**
   * A method that goes down in energy from a given gap g >= 0 to a stationary one. It
   * stops there, when the surfaces part, or after too many iterations. What the methods
   * differ in is how they go one iteration further; what follows from the gap is common
   * to them: the elastic traction K w, the derivative r of the energy by g, and the
   * curvature of the adhesion.
   */
  class GapOptimiser
  {
  public:
    GapOptimiser(GapProblem             &problem,
                 const GapConstraint    &constraint,
                 const ContactTolerance &tolerance);

    virtual ~GapOptimiser() = default;

    /**
     * @p gap_values: a start on entry (negative values count as 0), the solution on
     * return; exactly 0 in contact. The residual is the larger of max |r| over open
     * points and max −r over points in contact, in units of the tolerance's traction; r
     * is the derivative of the energy. Collective.
     */
    GapSolution solve(double *gap_values);

    /** The derivative r of the energy at the solution: the reaction of the wall in
     *  contact. Valid as long as this object. */
    const double *
    reaction() const
    {
      return derivative.data();
    }

    /**
     * Whether the solution is a minimum of the energy: the smallest eigenvalue μ that was
     * found of (K + γ'') v = μ (K + mean_stiffness() M) v, M the mean, on the points
     * where the gap is positive, for the others are held by the wall. All v have the mean
     * 0 if that of the gap is held.
     *
     * It is sought by preconditioned conjugate gradients on the Rayleigh quotient, each
     * time to the least along the line. It is at most 1; a minimum has μ > 0. The
     * quotient bounds μ from above, so a negative one is proof that the gap is no
     * minimum.
     *
     * The solution is that of the last solve(), whose gap must be as it was left.
     * @p v is a start on entry, or noise if it is empty on all ranks.
     * Needs five fields with it. Collective.
     */
    double smallest_curvature(std::vector<double> &v) const;

  protected:
    /** Forget what was learned on the way to another solution. */
    virtual void
    begin()
    {
    }

    /** One iteration from the present gap, whose residual is @p residual. Returns whether
     *  the energy fell. */
    virtual bool descend(double residual) = 0;

    /** A field of zeros, for a method to keep. */
    std::vector<double>
    field() const
    {
      return std::vector<double>(problem.size);
    }

    /** What follows from the gap as it is, after it was changed by others. One
     *  application of K; collective. */
    void refresh();

    /**
     * g += length·d, where the response is K d and <d, Kd> is @p work; negative
     * values that rounding leaves become 0. Collective.
     */
    void
    move(const double *direction, const double *response, double work, double length);

    /** The values that an admissible gap may not have become the nearest ones, at
     *  the prescribed mean. Collective. */
    void make_admissible(double *values) const;

    /** Values 0 off the free points, and at fixed mean gap of the mean 0 on them.
     *  Collective. */
    void project_on_free(double *values) const;

    /** Replace @p z by M z on the free points. Collective. */
    void precondition(double *z);

    /** Open, or in contact but pulled away: free to move. */
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
    double                 pressure = 0; // p0, at fixed mean gap so that ⟨r⟩ = 0
    double elastic_energy           = 0; // ½⟨w, Kw⟩, and p0 ⟨g⟩ at fixed load
    double adhesive_energy          = 0;
    std::vector<std::uint8_t> closed; // scratch: marks of points that are not free
    double largest_violation = 0;     // of the conditions of a minimum [pressure]
    double smallest_gap      = 0;
  };
} // namespace strait
