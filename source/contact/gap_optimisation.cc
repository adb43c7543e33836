// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_optimisation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
        // In iterations. Half of it risks giving up on a slow way to another state,
        // double of it only reports a failure later.
        constexpr int patience = 200;
        if (residual < least_residual ||
            energy < least_energy - energy_noise * std::abs(energy))
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

  GapIterate::GapIterate(GapProblem &problem_, const GapConstraint &constraint_)
    : elastic(problem_.size())
    , derivative(problem_.size())
    , curvature(problem_.size())
    , problem(problem_)
    , constraint(constraint_)
    , pressure(constraint_.fixes_mean_gap ? 0. : constraint_.value)
  {
  }

  void
  GapIterate::start(double *values)
  {
    gap = values;
    make_admissible(gap);
    refresh();
  }

  void
  GapIterate::make_admissible(double *values) const
  {
    const auto [sum] = weighted_sums<1>(problem, [=](const auto i, auto &sums) {
      values[i] = std::max(values[i], 0.);
      sums[0] += values[i];
    });
    if (!constraint.fixes_mean_gap)
      return;
    // A factor keeps closed points closed.
    const double factor = sum > 0 ? constraint.value / sum : 0.;
    for (std::size_t i = 0; i < problem.size(); ++i)
      values[i] = sum > 0 ? values[i] * factor : constraint.value;
  }

  void
  GapIterate::refresh()
  {
    const double   *h = problem.heights();
    double         *g = gap, *w = derivative.data();
    WeightedSums<1> mean;
    const double    work =
      problem.apply(w, elastic.data(), [&](const ContactProblem::Block &range) {
        mean.run_over(range, [=](const auto i, auto &sums) {
          w[i] = g[i] + h[i];
          sums[0] += g[i];
        });
      });
    elastic_energy = .5 * work;
    if (!constraint.fixes_mean_gap)
      elastic_energy += pressure * mean.over_ranks(problem)[0];
    evaluate();
  }

  void
  GapIterate::move(const double *direction,
                   const double *response,
                   const double  work,
                   const double  length)
  {
    double *g = gap, *e = elastic.data();
    const auto [along_e, along] =
      weighted_sums<2>(problem, [=](const auto i, auto &sums) {
        sums[0] += direction[i] * e[i];
        sums[1] += direction[i];
        e[i] += length * response[i];
        g[i] = std::max(g[i] + length * direction[i], 0.);
      });
    elastic_energy += length * (along_e + .5 * length * work);
    if (!constraint.fixes_mean_gap)
      elastic_energy += length * pressure * along;
    evaluate();
  }

  /** All that follows from the gap and K w. */
  void
  GapIterate::evaluate()
  {
    const double *g = gap, *e = elastic.data();
    double       *r      = derivative.data();
    double        energy = 0, open_force = 0, open_area = 0;
    double        least = std::numeric_limits<double>::infinity();
    for (const ContactProblem::Block &block : problem.blocks())
      {
        const std::size_t begin = block.begin, n = block.end - begin;
        energy += block.weight *
                  problem.adhesion().evaluate(n, g + begin, r + begin, &curvature[begin]);
        double force = 0, n_open = 0;
        for (std::size_t i = begin; i < block.end; ++i)
          {
            r[i] += e[i];
            force += g[i] > 0 ? r[i] : 0.;
            n_open += g[i] > 0 ? 1. : 0.;
            least = std::min(least, g[i]);
          }
        open_force += block.weight * force;
        open_area += block.weight * n_open;
      }
    std::array<double, 3> sums = {{energy, open_force, open_area}};
    problem.sum_over_ranks(sums.data(), 3);
    adhesive_energy = sums[0];
    if (constraint.fixes_mean_gap)
      pressure = sums[2] > 0 ? -sums[1] / sums[2] : 0.;
    const double p0    = pressure;
    double       worst = 0;
    for (std::size_t i = 0, n = problem.size(); i < n; ++i)
      {
        r[i] += p0;
        if (const double here = g[i] > 0 ? std::abs(r[i]) : -r[i]; !(here <= worst))
          worst = std::isnan(here) ? std::numeric_limits<double>::infinity() : here;
      }
    largest_violation = problem.largest_over_ranks(worst);
    smallest_gap      = -problem.largest_over_ranks(-least);
  }

  bool
  GapIterate::is_detached() const
  {
    return !constraint.fixes_mean_gap && pressure < 0 && smallest_gap > 0 &&
           problem.adhesion().at(smallest_gap).traction < -.5 * pressure;
  }

  void
  GapIterate::describe(GapSolution &solution) const
  {
    solution.energy           = energy();
    solution.adhesive_energy  = adhesive_energy;
    solution.nominal_pressure = pressure;
    solution.detached         = is_detached();
  }

  GapOptimiser::GapOptimiser(GapProblem             &problem_,
                             const GapConstraint    &constraint,
                             const ContactTolerance &tolerance_)
    : problem(problem_)
    , iterate(problem_, constraint)
    , tolerance(tolerance_)
  {
  }

  GapSolution
  GapOptimiser::solve(double *gap)
  {
    begin();
    iterate.start(gap);
    GapSolution solution;
    Stagnation  stagnation;
    while (true)
      {
        solution.residual  = iterate.violation() / tolerance.unit;
        solution.converged = solution.residual <= tolerance.residual;
        solution.way.push_back(
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
