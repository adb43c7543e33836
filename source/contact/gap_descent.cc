// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_descent.h>

#include <cmath>
#include <utility>

namespace strait
{
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
    while (true)
      {
        solution.residual  = iterate.violation() / tolerance.traction;
        solution.converged = solution.residual <= tolerance.residual;
        if (observer)
          observer(
            {solution.iterations, iterate.energy(), solution.residual, step_length});
        if (solution.converged || solution.iterations >= tolerance.max_iterations ||
            !std::isfinite(solution.residual) || iterate.is_detached())
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
