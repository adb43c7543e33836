// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /**
     * The textbook method, for reference: conjugate gradients on the pressure that
     * truncate negative pressures in every step (Polonsky, Keer, Wear 231, 1999).
     * Problem, residual and result are those of DualConjugateGradients, without an upper
     * limit. Each step that changes the contact costs two applications of G. Needs 16 B
     * per local point in addition to the two fields.
     */
    ContactSolution
    polonsky_keer(const DualTask &task)
    {
      DualProblem             &problem    = task.problem;
      const ContactConstraint &constraint = task.constraint;
      const double *const      h          = problem.heights;
      const double             u0         = constraint.displacement();
      double *const p = task.pressure, *const g = task.gap;
      std::vector<double> t(problem.size), r(problem.size); // direction, G t
      bool                restarts = true; // because points were added to the contact

      // Follow the direction. Returns false if there is no minimum along it.
      const auto step = [&]() {
        problem.apply(t.data(), r.data());
        const auto [g_t, r_t, sum_r, sum_t, area] =
          weighted_sums<5>(problem, [&](const auto i, auto &sums) {
            const double pressed = p[i] > 0 ? 1. : 0.;
            sums[0] += pressed * g[i] * t[i];
            sums[1] += pressed * r[i] * t[i];
            sums[2] += pressed * r[i];
            sums[3] += t[i];
            sums[4] += pressed;
          });
        const double curvature = r_t - constraint.excess(sum_r, area) * sum_t;
        const double length    = g_t / curvature;
        if (!(curvature > 0 && std::isfinite(length)))
          return false;

        const auto [mean, truncated, added] =
          weighted_sums<3>(problem, [&](const auto i, auto &sums) {
            const bool pressed = p[i] > 0;
            p[i]               = pressed ? std::max(p[i] - length * t[i], 0.) : 0.;
            sums[1] += pressed && p[i] == 0 ? 1. : 0.;
            if (p[i] == 0 && g[i] < 0)
              {
                p[i] = -length * g[i];
                sums[2] += 1.;
              }
            sums[0] += p[i];
          });
        restarts                  = added > 0;
        const double factor       = constraint.rescale(mean);
        const bool   same_contact = truncated == 0 && added == 0;
        if (!same_contact)
          problem.apply(p, g);
        // A step within one contact set is linear: no second application is needed. (A
        // constant in g drops out when g is centred; if not centred, factor is 1.)
        for (std::size_t i = 0; i < problem.size; ++i)
          {
            p[i] *= factor;
            g[i] = same_contact ? factor * (g[i] - u0 + h[i] - length * r[i]) + u0 - h[i]
                                : factor * g[i] + u0 - h[i];
          }
        return true;
      };

      // p = max(p, 0) with the prescribed mean, g = G p + u0 − h.
      const WithinLimits limit =
        within_limits(problem, constraint, std::vector<std::uint8_t>(problem.size, 1), p);
      for (std::size_t i = 0; i < problem.size; ++i)
        p[i] = limit(p[i], true);
      problem.apply(p, g);
      for (std::size_t i = 0; i < problem.size; ++i)
        g[i] += u0 - h[i];
      ContactSolution solution;
      double          last_squared = 0; // <g, g> under pressure, one step before
      for (;; ++solution.iterations)
        {
          // Add the rigid displacement to the gap.
          const auto [sum_g, area] =
            weighted_sums<2>(problem, [&](const auto i, auto &sums) {
              sums[0] += p[i] > 0 ? g[i] : 0.;
              sums[1] += p[i] > 0 ? 1. : 0.;
            });
          const double shift   = constraint.excess(sum_g, area);
          double       worst   = 0;
          const auto [squared] = weighted_sums<1>(problem, [&](const auto i, auto &sums) {
            g[i] -= shift;
            worst = std::max(worst, p[i] > 0 ? std::abs(g[i]) : -g[i]);
            sums[0] += p[i] > 0 ? g[i] * g[i] : 0.;
          });
          solution.residual  = maximum(problem.communicator, worst) / task.tolerance.unit;
          solution.converged = solution.residual <= task.tolerance.residual;
          if (solution.converged || solution.iterations >= task.tolerance.max_iterations)
            break;
          const double beta = restarts ? 0. : squared / last_squared;
          last_squared      = squared;
          for (std::size_t i = 0; i < problem.size; ++i)
            t[i] = p[i] > 0 ? g[i] + beta * t[i] : 0.;
          if (!step())
            break;
        }
      return solution;
    }
  } // namespace

  ContactSolution
  find_pressure(const ContactMethod method, const DualTask &task)
  {
    return method == ContactMethod::polonsky_keer ? polonsky_keer(task)
                                                  : DualConjugateGradients(task).solve();
  }
} // namespace strait
