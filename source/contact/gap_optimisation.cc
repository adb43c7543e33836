// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/iteration.h>
#include <strait/contact/gap_optimisation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  GapOptimiser::GapOptimiser(GapProblem             &problem_,
                             const GapConstraint    &constraint_,
                             const ContactTolerance &tolerance_)
    : problem(problem_)
    , constraint(constraint_)
    , tolerance(tolerance_)
    , pressure(constraint_.fixes_mean_gap ? 0. : constraint_.value)
  {
  }

  void
  GapOptimiser::make_admissible(double *values) const
  {
    const auto [sum] = weighted_sums<1>(problem, [=](const auto i, auto &sums) {
      values[i] = std::max(values[i], 0.);
      sums[0] += values[i];
    });
    if (!constraint.fixes_mean_gap)
      return;
    // Scaling keeps closed points closed.
    const double factor = sum > 0 ? constraint.value / sum : 0.;
    for (std::size_t i = 0; i < problem.size; ++i)
      values[i] = sum > 0 ? values[i] * factor : constraint.value;
  }

  void
  GapOptimiser::project_on_free(double *values) const
  {
    for (std::size_t i = 0; i < problem.size; ++i)
      values[i] = is_free(i) ? values[i] : 0.;
    if (!constraint.fixes_mean_gap)
      return;
    const auto [sum, area] = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      sums[0] += values[i];
      sums[1] += is_free(i) ? 1. : 0.;
    });
    const double mean      = area > 0 ? sum / area : 0.;
    for (std::size_t i = 0; i < problem.size; ++i)
      values[i] -= is_free(i) ? mean : 0.;
  }

  void
  GapOptimiser::precondition(double *z)
  {
    closed.resize(problem.size);
    for (std::size_t i = 0; i < problem.size; ++i)
      {
        closed[i] = !is_free(i);
        z[i]      = is_free(i) ? z[i] : 0.;
      }
    problem.precondition(z, closed.data());
    project_on_free(z);
  }

  void
  GapOptimiser::refresh()
  {
    double *w         = derivative.data();
    const auto [mean] = weighted_sums<1>(problem, [=](const auto i, auto &sums) {
      w[i] = gap[i] + problem.heights[i];
      sums[0] += gap[i];
    });
    elastic_energy    = .5 * problem.apply(w, elastic.data());
    if (!constraint.fixes_mean_gap)
      elastic_energy += pressure * mean;
    evaluate();
  }

  void
  GapOptimiser::move(const double *direction,
                     const double *response,
                     const double  work,
                     const double  length)
  {
    // A point that a step closes may keep this fraction of the step by rounding. It would
    // count as free, and no step that closes it again would be downhill for the others.
    constexpr double rest = 1e-14;
    double          *g = gap, *e = elastic.data();
    const auto [along_e, along] =
      weighted_sums<2>(problem, [=](const auto i, auto &sums) {
        sums[0] += direction[i] * e[i];
        sums[1] += direction[i];
        e[i] += length * response[i];
        const double step = length * direction[i], next = g[i] + step;
        g[i] = next > -rest * step ? std::max(next, 0.) : 0.;
      });
    elastic_energy += length * (along_e + .5 * length * work);
    if (!constraint.fixes_mean_gap)
      elastic_energy += length * pressure * along;
    evaluate();
  }

  /** Compute all that follows from the gap and K w. Collective. */
  void
  GapOptimiser::evaluate()
  {
    const double *g = gap, *e = elastic.data();
    double       *r     = derivative.data();
    double        least = std::numeric_limits<double>::infinity(), adhesive = 0;
    for (const SlabLayout::Range &range : problem.ranges)
      {
        const std::size_t begin = range.begin, n = range.end - begin;
        adhesive += range.area / problem.n_points *
                    problem.adhesion.evaluate(n, g + begin, r + begin, &curvature[begin]);
      }
    adhesive_energy = sum(problem.communicator, adhesive);
    // The force on the open points, and their number.
    const auto [open_force, open_area] =
      weighted_sums<2>(problem, [=, &least](const auto i, auto &sums) {
        r[i] += e[i];
        sums[0] += g[i] > 0 ? r[i] : 0.;
        sums[1] += g[i] > 0 ? 1. : 0.;
        least = std::min(least, g[i]);
      });
    if (constraint.fixes_mean_gap)
      pressure = open_area > 0 ? -open_force / open_area : 0.;
    const double p0    = pressure;
    double       worst = 0;
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      {
        r[i] += p0;
        if (const double here = g[i] > 0 ? std::abs(r[i]) : -r[i]; !(here <= worst))
          worst = std::isnan(here) ? std::numeric_limits<double>::infinity() : here;
      }
    largest_violation = maximum(problem.communicator, worst);
    smallest_gap      = minimum(problem.communicator, least);
  }

  /** Whether no point touches and the load pulls more than twice as strongly as the
   *  adhesion at any point. */
  bool
  GapOptimiser::is_detached() const
  {
    return !constraint.fixes_mean_gap && pressure < 0 && smallest_gap > 0 &&
           problem.adhesion.at(smallest_gap).traction < -.5 * pressure;
  }

  GapSolution
  GapOptimiser::solve(double *gap_values)
  {
    begin();
    gap = gap_values;
    make_admissible(gap);
    refresh();
    GapSolution solution;
    double      least_residual = std::numeric_limits<double>::infinity();
    double      least_energy   = least_residual;
    int         last_gain      = 0; // iteration of the last new low of residual or energy
    while (true)
      {
        solution.residual  = largest_violation / tolerance.unit;
        solution.converged = solution.residual <= tolerance.residual;
        solution.adhesion.relaxation.push_back(
          {solution.iterations, energy(), solution.residual, step_length});
        if (solution.residual < least_residual ||
            energy() < least_energy - energy_noise * std::abs(energy()))
          {
            least_residual = std::min(least_residual, solution.residual);
            least_energy   = std::min(least_energy, energy());
            last_gain      = solution.iterations;
          }
        if (solution.converged || solution.iterations >= tolerance.max_iterations ||
            !std::isfinite(solution.residual) || is_detached() ||
            solution.iterations - last_gain > iteration_limit)
          break;
        if (!descend(solution.residual))
          break;
        ++solution.iterations;
      }
    solution.nominal_pressure         = pressure;
    solution.adhesion.adhesive_energy = adhesive_energy;
    solution.adhesion.attraction      = problem.adhesion.at(0.).traction;
    solution.adhesion.total_energy    = energy();
    solution.adhesion.detached        = is_detached();
    return solution;
  }
} // namespace strait
