// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_dynamics.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // FIRE's own constants, but for the time steps: a mode's period is 2π.
    constexpr double first_time_step = .5, longest_time_step = 1.2;
    constexpr double shortest_time_step = .1;
    constexpr double first_mixing = .1, mixing_decay = .99;
    constexpr double speed_up = 1.1, slow_down = .5;
    constexpr int    steps_until_faster = 5;
  } // namespace

  GapDynamics::GapDynamics(GapProblem          &problem_,
                           const GapConstraint &constraint,
                           const GapTolerance  &tolerance_,
                           RelaxationObserver   observer_)
    : problem(problem_)
    , tolerance(tolerance_)
    , observer(std::move(observer_))
    , iterate(problem_, constraint)
    , velocity(problem_.size())
    , acceleration(problem_.size())
  {
  }

  GapSolution
  GapDynamics::solve(double *gap)
  {
    std::fill(velocity.begin(), velocity.end(), 0.);
    time_step     = first_time_step;
    mixing        = first_mixing;
    steps_forward = 0;
    iterate.start(gap);

    GapSolution solution;
    while (true)
      {
        solution.residual  = iterate.violation() / tolerance.traction;
        solution.converged = solution.residual <= tolerance.residual;
        if (observer)
          observer({solution.iterations, iterate.energy(), solution.residual, time_step});
        if (solution.converged || solution.iterations >= tolerance.max_iterations ||
            !std::isfinite(solution.residual) || iterate.is_detached())
          break;
        accelerate();
        steer();
        advance();
        ++solution.iterations;
      }
    iterate.describe(solution);
    return solution;
  }

  /** Forces over masses; a point that the wall holds stays where it is. */
  void
  GapDynamics::accelerate()
  {
    double *a = acceleration.data();
    problem.precondition(
      a,
      [&](const PointSet::Block &range) {
        for (std::size_t i = range.begin; i < range.end; ++i)
          a[i] = iterate.is_free(i) ? -iterate.derivative[i] : 0.;
      },
      no_pass);
    iterate.project(a);
    iterate.project(velocity.data());
  }

  void
  GapDynamics::steer()
  {
    const auto [power, v_v, a_a] =
      weighted_sums<3>(problem, [&](const auto i, auto &sums) {
        const double v = velocity[i], a = acceleration[i];
        sums[0] -= v * (iterate.is_free(i) ? iterate.derivative[i] : 0.);
        sums[1] += v * v;
        sums[2] += a * a;
      });
    if (power > 0)
      {
        const double pull = a_a > 0 ? mixing * std::sqrt(v_v / a_a) : 0.;
        for (std::size_t i = 0; i < problem.size(); ++i)
          velocity[i] = (1 - mixing) * velocity[i] + pull * acceleration[i];
        if (++steps_forward > steps_until_faster)
          {
            time_step = std::min(time_step * speed_up, longest_time_step);
            mixing *= mixing_decay;
          }
        return;
      }
    std::fill(velocity.begin(), velocity.end(), 0.);
    time_step     = std::max(time_step * slow_down, shortest_time_step);
    mixing        = first_mixing;
    steps_forward = 0;
  }

  void
  GapDynamics::advance()
  {
    double *g = iterate.gap;
    for (std::size_t i = 0; i < problem.size(); ++i)
      {
        velocity[i] += time_step * acceleration[i];
        g[i] += time_step * velocity[i];
        if (g[i] < 0)
          velocity[i] = 0;
      }
    iterate.make_admissible(g);
    iterate.refresh();
  }

  const double *
  GapDynamics::reaction() const
  {
    return iterate.derivative.data();
  }

  std::size_t
  GapDynamics::memory_consumption() const
  {
    return 4 * problem.size() * sizeof(double);
  }
} // namespace strait
