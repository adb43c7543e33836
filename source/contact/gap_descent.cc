// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_descent.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    /** Notices that nothing is to be gained any more. */
    class Stagnation
    {
    public:
      /** Whether neither the residual nor, beyond rounding, the energy has reached a new
       *  low for many iterations. */
      bool
      is_reached(const int iteration, const double energy, const double residual)
      {
        constexpr int    patience = 200;
        constexpr double rounding = 1e-12;
        if (residual < least_residual ||
            energy < least_energy - rounding * std::abs(energy))
          {
            least_residual = std::min(least_residual, residual);
            least_energy   = std::min(least_energy, energy);
            last_gain      = iteration;
          }
        return iteration - last_gain > patience;
      }

    private:
      double least_residual = std::numeric_limits<double>::infinity();
      double least_energy   = std::numeric_limits<double>::infinity();
      int    last_gain      = 0;
    };
  } // namespace

  GapDescent::GapDescent(GapProblem          &problem_,
                         const GapConstraint &constraint,
                         const GapTolerance  &tolerance_,
                         RelaxationObserver   observer_)
    : problem(problem_)
    , iterate(problem_, constraint)
    , tolerance(tolerance_)
    , observer(std::move(observer_))
  {
  }

  GapSolution
  GapDescent::solve(double *gap)
  {
    begin();
    iterate.start(gap);
    GapSolution solution;
    Stagnation  stagnation;
    while (true)
      {
        solution.residual  = iterate.violation() / tolerance.traction;
        solution.converged = solution.residual <= tolerance.residual;
        if (observer)
          observer(
            {solution.iterations, iterate.energy(), solution.residual, step_length});
        if (solution.converged || solution.iterations >= tolerance.max_iterations ||
            !std::isfinite(solution.residual) || iterate.is_detached() ||
            stagnation.is_reached(solution.iterations,
                                  iterate.energy(),
                                  solution.residual))
          break;
        const Outcome outcome = descend(solution.residual);
        if (outcome == Outcome::stuck)
          break;
        if (outcome == Outcome::moved)
          ++solution.iterations;
      }
    iterate.describe(solution);
    return solution;
  }
} // namespace strait
