// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  ContactSolution
  DualConjugateGradients::solve()
  {
    for (const Block &block : problem.blocks)
      for (std::size_t i = block.begin; i < block.end; ++i)
        in_contact[i] = pressure[i] != 0;

    ContactSolution solution;
    double          least_residual = std::numeric_limits<double>::infinity();
    find_gap();
    while (true)
      {
        solution.residual = survey(); // C, y, and z = M y
        const bool small  = solution.residual <= tolerance.residual;
        const bool late   = solution.iterations >= tolerance.max_iterations;
        if (!any_beyond && (small || late || !std::isfinite(energy)))
          {
            if (gap_is_exact)
              {
                solution.converged = small && std::isfinite(energy);
                break;
              }
            find_gap();
            continue;
          }

        const double slope    = choose_direction();
        bool         followed = true; // a direction, by more than truncation
        if (any_beyond)
          {
            // Truncation alone where more has not helped or the pressure has two limits:
            // where many points neither bear nor part it may lead round in circles.
            followed = !late && !cautious && !constraint.is_limited() &&
                       solution.residual < least_residual;
            step_within_limits(followed ? last_length : 0.);
            least_residual = std::min(least_residual, solution.residual);
          }
        else if (!step(slope))
          {
            if (gap_is_exact) // nothing is left to improve: one point, say
              break;
            find_gap();
          }
        watch_energy();
        solution.iterations += followed ? 1 : 0;
      }

    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      gap[i] -= shift;
    return solution;
  }

  /** p within its limits with the prescribed mean, and g = G p + u0 − h in all digits. */
  void
  DualConjugateGradients::find_gap()
  {
    double            *p = pressure, *g = gap;
    const double      *h     = problem.heights;
    const WithinLimits limit = within_limits(problem, constraint, in_contact, p);
    const auto [mean, p_h]   = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      p[i]          = limit(p[i], in_contact[i] != 0);
      in_contact[i] = p[i] != 0;
      sums[0] += p[i];
      sums[1] += p[i] * h[i];
    });
    const double u0          = constraint.displacement();
    free_points              = {};
    const double p_Gp        = problem.apply(p, g, [&](const Block &range, const double) {
      for (std::size_t i = range.begin; i < range.end; ++i)
        g[i] += u0 - h[i];
      measure_free(range);
    });
    note_free();
    gap_is_exact = true;
    truncated    = false;
    // What follows is conjugate to no step that led to another gap.
    std::fill(direction.begin(), direction.end(), 0.f);
    std::fill(response.begin(), response.end(), 0.f);

    const double elastic = 0.5 * p_Gp;
    const double work    = p_h - u0 * mean;
    energy               = elastic - work;
    energy_scale         = elastic + std::abs(work);
    lowest_energy        = energy;
    cautious             = false;
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
      in_contact.data(),
      [&](const Block &range) { worst = std::max(worst, choose_contact(range)); },
      [&](const Block &range) { measure(range); });
    return maximum(problem.communicator, worst) / tolerance.unit;
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
        float              *z = problem.scratch();
        const double       *g = gap;
        const std::uint8_t *c = in_contact.data();
        const auto [y_y]      = weighted_sums<1>(
          problem, [=, s = shift, unit = 1. / tolerance.unit](const auto i, auto &sums) {
            z[i] = c[i] ? static_cast<float>(unit * (g[i] - s)) : 0.f;
            sums[0] += static_cast<double>(z[i]) * z[i];
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

  /** Form t and go to the minimum along it. Return whether there is one. */
  bool
  DualConjugateGradients::step(const double slope)
  {
    free_points            = {};
    const double curvature = problem.respond(
      direction.data(),
      response.data(),
      [&](const Block &range) { form_direction(range, direction.data()); },
      [&](const Block &range, const double t_r) {
        move(range, t_r > 0 ? slope / t_r : 0.);
      });
    note_free();
    if (!(curvature > 0))
      return false;
    gap_is_exact = false;
    truncated    = false;
    last_length  = slope / curvature;
    energy -= 0.5 * (tolerance.unit * tolerance.unit) * slope * last_length;
    return true;
  }

  /** Whether any pressure is beyond its limits, and what the gap is off by: its mean on
   *  the points between the limits. */
  void
  DualConjugateGradients::note_free()
  {
    const auto [beyond, sum_g, area] = free_points.over_ranks(problem);
    any_beyond                       = beyond > 0;
    shift                            = constraint.excess(sum_g, area);
    if (area > 0 || !constraint.is_limited())
      return;
    // Every pressure is at a limit: between the gaps that let points leave either.
    double least_open   = std::numeric_limits<double>::infinity();
    double most_pressed = -least_open;
    for (const ContactProblem::Block &block : problem.blocks)
      for (std::size_t i = block.begin; i < block.end; ++i)
        if (pressure[i] == 0)
          least_open = std::min(least_open, gap[i]);
        else
          most_pressed = std::max(most_pressed, gap[i]);
    shift = .5 * (maximum(problem.communicator, most_pressed) -
                  maximum(problem.communicator, -least_open));
  }

  ContactSolution
  find_pressure(const ContactMethod method, const DualTask &task)
  {
    return method == ContactMethod::polonsky_keer ? PolonskyKeer(task).solve()
                                                  : DualConjugateGradients(task).solve();
  }
} // namespace strait
