// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_iterate.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  GapIterate::GapIterate(GapProblem &problem_, const GapConstraint &constraint_)
    : problem(problem_)
    , constraint(constraint_)
    , elastic(problem_.size())
    , derivative(problem_.size())
    , law(problem_.adhesion())
    , pressure(constraint_.fixes_mean_gap() ? 0. : constraint_.value)
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
    if (!constraint.fixes_mean_gap())
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
    const double    work = problem.apply(
      w,
      elastic.data(),
      [&](const PointSet::Block &range) {
        mean.run_over(range, [=](const auto i, auto &sums) {
          w[i] = g[i] + h[i];
          sums[0] += g[i];
        });
      },
      no_pass);
    elastic_energy = .5 * work;
    if (!constraint.fixes_mean_gap())
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
    if (!constraint.fixes_mean_gap())
      elastic_energy += length * pressure * along;
    evaluate();
  }

  void
  GapIterate::project(double *values) const
  {
    for (std::size_t i = 0, n = problem.size(); i < n; ++i)
      values[i] = is_free(i) ? values[i] : 0.;
    if (!constraint.fixes_mean_gap())
      return;
    const auto [sum, area] = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      sums[0] += values[i];
      sums[1] += is_free(i) ? 1. : 0.;
    });
    const double mean      = area > 0 ? sum / area : 0.;
    for (std::size_t i = 0, n = problem.size(); i < n; ++i)
      values[i] -= is_free(i) ? mean : 0.;
  }

  /** All that follows from the gap and K w. */
  void
  GapIterate::evaluate()
  {
    const double     *g = gap, *e = elastic.data();
    double           *r     = derivative.data();
    const AdhesionLaw gamma = law;
    const double      most  = gamma.traction(0.);
    double            least = std::numeric_limits<double>::infinity();
    const auto [attraction, open_force, open_area] =
      weighted_sums<3>(problem, [&, g, e, r](const auto i, auto &sums) {
        const double traction = g[i] > 0 ? gamma.traction(g[i]) : most;
        r[i]                  = e[i] + traction;
        sums[0] += traction;
        sums[1] += g[i] > 0 ? r[i] : 0.;
        sums[2] += g[i] > 0 ? 1. : 0.;
        least = std::min(least, g[i]);
      });
    adhesive_energy = gamma.energy(attraction);
    if (constraint.fixes_mean_gap())
      pressure = open_area > 0 ? -open_force / open_area : 0.;
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
    return !constraint.fixes_mean_gap() && pressure < 0 && smallest_gap > 0 &&
           law.traction(smallest_gap) < -.5 * pressure;
  }

  void
  GapIterate::describe(GapSolution &solution) const
  {
    solution.energy           = energy();
    solution.adhesive_energy  = adhesive_energy;
    solution.nominal_pressure = pressure;
    solution.detached         = is_detached();
  }
} // namespace strait
