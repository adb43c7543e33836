// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  ContactSolution
  DualConjugateGradients::solve(double *pressures, double *gaps)
  {
    pressure      = pressures;
    gap           = gaps;
    lowest_energy = std::numeric_limits<double>::infinity();
    std::fill(direction.begin(), direction.end(), 0.);
    std::fill(response.begin(), response.end(), 0.);
    for (std::size_t i = 0, n = problem.size(); i < n; ++i)
      in_contact[i] = pressure[i] > 0;

    ContactSolution solution;
    bool            truncation_due   = true;
    int             since_truncation = 0;
    while (true)
      {
        if (truncation_due || (any_beyond && (cautious || since_truncation >= 2)))
          {
            truncate();
            since_truncation = 0;
            truncation_due   = false;
          }
        solution.residual = survey(); // C, y, and z = M y
        const bool small  = solution.residual <= tolerance.residual;
        const bool late   = solution.iterations >= tolerance.max_iterations;
        if (!any_beyond && (small || late || !std::isfinite(energy)))
          {
            solution.converged = small && std::isfinite(energy);
            break;
          }
        if (any_beyond && (solution.residual <= 0.3 * tolerance.residual || late))
          {
            truncation_due = true;
            continue;
          }

        const double slope     = choose_direction();
        const double curvature = step(slope);
        if (!(curvature > 0))
          {
            if (!any_beyond) // nothing is left to improve: one point, say
              break;
            truncation_due = true;
            continue;
          }
        energy -= 0.5 * slope * slope / curvature;
        watch_energy();
        ++since_truncation;
        ++solution.iterations;
      }

    for (std::size_t i = 0, n = problem.size(); i < n; ++i)
      gap[i] -= shift;
    return solution;
  }

  // The loops below run over all points and are bound by the memory: they are fused
  // into passes over ranges that stay in the cache, and touch p, t and z only in
  // contact. They work on local copies of members because, for all the compiler
  // knows, a write to a field might change a member.

  /** p within its limits with the prescribed mean, g = G p + u0 − h. */
  void
  DualConjugateGradients::truncate()
  {
    double       *p = pressure, *g = gap;
    const double *h = problem.heights(), limit = constraint.limit();
    if (constraint.is_limited())
      bring_within_limits(problem, constraint, in_contact, p);

    const auto [mean, p_h] = weighted_sums<2>(problem, [=](const auto i, auto &sums) {
      p[i] = p[i] > 0 ? p[i] : 0.;
      sums[0] += p[i];
      sums[1] += p[i] * h[i];
    });
    const double    factor = constraint.rescale(mean);
    const double    u0     = constraint.displacement();
    WeightedSums<2> contact_sums;
    const double    p_Gp =
      problem.apply(p, g, no_pass, [&](const Block &range, const double) {
        contact_sums.run_over(range, [=](const auto i, auto &sums) {
          const double free = p[i] != 0 && p[i] != limit ? 1. : 0.;
          p[i] *= factor;
          g[i] = factor * g[i] + (u0 - h[i]);
          sums[0] += free * g[i];
          sums[1] += free;
        });
      });
    const auto [sum_g, area] = contact_sums.over_ranks(problem);
    shift                    = rigid_shift(sum_g, area);
    any_beyond               = false;

    const double elastic = 0.5 * factor * factor * p_Gp;
    const double work    = factor * (p_h - u0 * mean);
    energy               = elastic - work;
    energy_scale         = elastic + std::abs(work);
    watch_energy();
  }

  /** What the gap is off by: its mean on the points between the limits, of sum @p sum_g
   *  and weight @p area. */
  double
  DualConjugateGradients::rigid_shift(const double sum_g, const double area) const
  {
    if (area > 0 || !constraint.is_limited())
      return constraint.excess(sum_g, area);
    // Every pressure is at a limit: between the gaps that let points leave either.
    double least_open   = std::numeric_limits<double>::infinity();
    double most_pressed = -least_open;
    for (std::size_t i = 0, n = problem.size(); i < n; ++i)
      if (pressure[i] == 0)
        least_open = std::min(least_open, gap[i]);
      else
        most_pressed = std::max(most_pressed, gap[i]);
    return .5 * (problem.largest_over_ranks(most_pressed) -
                 problem.largest_over_ranks(-least_open));
  }

  void
  DualConjugateGradients::watch_energy()
  {
    if (any_beyond)
      return;
    cautious      = energy > lowest_energy + 1e-12 * energy_scale;
    lowest_energy = std::min(lowest_energy, energy);
  }

  /**
   * Choose C, precondition the gap y on it and measure what the next direction
   * depends on. Leave z = M y in the scratch room. Return the residual.
   */
  double
  DualConjugateGradients::survey()
  {
    double worst = 0;
    on_contact   = {};
    problem.precondition(
      problem.scratch(),
      [&](const Block &range) { worst = std::max(worst, choose_contact(range)); },
      [&](const Block &range) { measure(range); });
    return problem.largest_over_ranks(worst) / tolerance.length;
  }

  /**
   * C: the points between the limits of the pressure and, unless some pressure is beyond
   * these, those that penetrate without pressure or part under the largest. Set y, the
   * gap on C and 0 elsewhere. Return the residual.
   */
  double
  DualConjugateGradients::choose_contact(const Block &range)
  {
    const double *p = pressure, *g = gap;
    double       *y     = problem.scratch();
    std::uint8_t *c     = in_contact.data();
    const double  s     = shift;
    const double  limit = constraint.limit();
    const bool    grows = !any_beyond;
    double        worst = 0;
    for (std::size_t i = range.begin, end = range.end; i < end; ++i)
      {
        const double centred  = g[i] - s;
        const bool   is_free  = p[i] != 0 && p[i] != limit;
        const bool   is_wrong = is_free || (p[i] == 0 ? centred < 0 : centred > 0);
        c[i]                  = is_free || (is_wrong && grows);
        y[i]                  = c[i] ? centred : 0.;
        worst                 = is_wrong ? std::max(worst, std::abs(centred)) : worst;
      }
    return worst;
  }

  void
  DualConjugateGradients::measure(const Block &range)
  {
    const double       *g = gap, *z = problem.scratch();
    const double       *t = direction.data(), *r = response.data();
    const std::uint8_t *c = in_contact.data();
    on_contact.run_over(range, [=, s = shift](const auto i, auto &sums) {
      if (!c[i])
        return;
      const double z_i = z[i], t_i = t[i], r_i = r[i], y_i = g[i] - s;
      sums[0] += 1;
      sums[1] += z_i;
      sums[2] += t_i;
      sums[3] += y_i;
      sums[4] += r_i;
      sums[5] += z_i * r_i;
      sums[6] += t_i * r_i;
      sums[7] += y_i * z_i;
      sums[8] += y_i * t_i;
    });
  }

  /**
   * Make the direction t = z + beta t on C conjugate to the last one and
   * admissible. Return <y, t> > 0.
   */
  double
  DualConjugateGradients::choose_direction()
  {
    auto [area, sum_z, sum_t, sum_y, sum_r, z_r, t_r, y_z, y_t] =
      on_contact.over_ranks(problem);
    mean_z          = constraint.excess(sum_z, area);
    mean_t          = constraint.excess(sum_t, area);
    double gradient = y_z - mean_z * sum_y;
    beta            = 0;
    if (!(gradient > 0))
      {
        // M is not positive on this C: do without it.
        double             *z = problem.scratch();
        const double       *g = gap;
        const std::uint8_t *c = in_contact.data();
        const auto [y_y] =
          weighted_sums<1>(problem, [=, s = shift](const auto i, auto &sums) {
            z[i] = c[i] ? g[i] - s : 0.;
            sums[0] += z[i] * z[i];
          });
        mean_z = constraint.excess(sum_y, area);
        return y_y - mean_z * sum_y;
      }
    if (!cautious && t_r > 0)
      beta = std::max(0., -(z_r - mean_z * sum_r) / t_r);
    const double slope = gradient + beta * (y_t - mean_t * sum_y);
    if (slope > 0)
      return slope;
    beta = 0;
    return gradient;
  }

  /** Form t, find r = G t, and go to the minimum along t. Return <t, r>. */
  double
  DualConjugateGradients::step(const double slope)
  {
    moved                  = {};
    const double curvature = problem.apply(
      direction.data(),
      response.data(),
      [&](const Block &range) { form_direction(range); },
      [&](const Block &range, const double t_r) {
        move(range, t_r > 0 ? slope / t_r : 0.);
      });
    const auto [beyond, sum_g, area] = moved.over_ranks(problem);
    any_beyond                       = beyond > 0;
    shift                            = rigid_shift(sum_g, area);
    return curvature;
  }

  void
  DualConjugateGradients::form_direction(const Block &range)
  {
    const double       *z  = problem.scratch();
    double             *t  = direction.data();
    const std::uint8_t *c  = in_contact.data();
    const double        z0 = mean_z, b = beta, t0 = mean_t;
    for (std::size_t i = range.begin, end = range.end; i < end; ++i)
      t[i] = c[i] ? (z[i] - z0) + b * (t[i] - t0) : 0.;
  }

  /** p −= length t, g −= length r; absorb the shift. */
  void
  DualConjugateGradients::move(const Block &range, const double length)
  {
    double       *p = pressure, *g = gap;
    const double *t = direction.data(), *r = response.data();
    const double  s = shift;
    for (std::size_t i = range.begin, end = range.end; i < end; ++i)
      g[i] = (g[i] - s) - length * r[i];

    const std::uint8_t *c     = in_contact.data();
    const double        limit = constraint.limit();
    moved.run_over(range, [=](const auto i, auto &sums) {
      if (!c[i]) // p stays at its limit, t = 0
        return;
      const double new_p = p[i] - length * t[i];
      p[i]               = new_p;
      if (new_p == 0 || new_p == limit)
        return;
      sums[0] += new_p < 0 || new_p > limit ? 1. : 0.;
      sums[1] += g[i];
      sums[2] += 1;
    });
  }

  std::size_t
  DualConjugateGradients::memory_consumption() const
  {
    return (direction.size() + response.size()) * sizeof(double) + in_contact.size();
  }
} // namespace strait
