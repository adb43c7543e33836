// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_optimisation_h
#define strait_contact_optimisation_h

#include <strait/contact/dual_problem.h>

#include <array>
#include <cstddef>
#include <vector>

namespace strait
{
  /**
   * What is held while the pressure p >= 0 is sought: its mean (force control;
   * the rigid displacement u0 of g = Gp + u0 − h follows) or u0 (gap control).
   */
  class ContactConstraint
  {
  public:
    static ContactConstraint mean_pressure(double pressure);
    static ContactConstraint rigid_displacement(double displacement);

    /** The rigid displacement of gap control; 0 where it is unknown. */
    double
    displacement() const
    {
      return fixes_pressure ? 0. : value;
    }

    /**
     * The mean that a field with the sum @p sum over points of total weight
     * @p weight must lose to be admissible: none in gap control.
     */
    double
    excess(const double sum, const double weight) const
    {
      return fixes_pressure && weight > 0 ? sum / weight : 0.;
    }

    /** The factor that gives a pressure of the mean @p mean the prescribed one. */
    double
    rescale(const double mean) const
    {
      return fixes_pressure ? value / mean : 1.;
    }

  private:
    ContactConstraint(bool fixes_pressure, double value)
      : fixes_pressure(fixes_pressure)
      , value(value)
    {
    }

    bool   fixes_pressure;
    double value;
  };

  /** When an optimiser stops. */
  struct ContactTolerance
  {
    double residual;       // in units of `length`
    double length;         // the rms height
    int    max_iterations; // one for each direction that is followed
  };

  /** Where an optimiser stopped: p >= 0, g = Gp + u0 − h, u0 included. */
  struct ContactSolution
  {
    /**
     * The larger of max |g| where p > 0 and max −g where p = 0, over the length
     * of the tolerance. The constraint holds exactly.
     */
    double residual   = 0;
    int    iterations = 0;
    bool   converged  = false;
  };

  /** N sums over points, weighted by area. */
  template <std::size_t N>
  class WeightedSums
  {
  public:
    /** add(i, sums) adds the values of point i of @p range to the N sums. */
    template <class Add>
    void
    run_over(const DualProblem::Block &range, const Add &add)
    {
      std::array<double, N> sums{};
      for (std::size_t i = range.begin; i < range.end; ++i)
        add(i, sums);
      for (std::size_t k = 0; k < N; ++k)
        local[k] += range.weight * sums[k];
    }

    /** Collective: the sums over all ranks. */
    std::array<double, N>
    over_ranks(const DualProblem &problem) const
    {
      std::array<double, N> total = local;
      problem.sum_over_ranks(total.data(), static_cast<int>(N));
      return total;
    }

  private:
    std::array<double, N> local{};
  };

  /** The same over all points at once. Collective. */
  template <std::size_t N, class Add>
  std::array<double, N>
  weighted_sums(const DualProblem &problem, const Add &add)
  {
    WeightedSums<N> sums;
    for (const DualProblem::Block &block : problem.blocks())
      sums.run_over(block, add);
    return sums.over_ranks(problem);
  }

  /** For DualProblem: nothing to do before or after. */
  inline void
  no_pass(const DualProblem::Block &)
  {
  }

  inline void
  no_work_pass(const DualProblem::Block &, double)
  {
  }
} // namespace strait

#endif
