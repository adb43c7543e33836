// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  bool
  GapNewton::descend(const double residual)
  {
    solve_model(residual);
    return search();
  }

  /** Find an approximate minimiser of the quadratic model on the free points: step. */
  void
  GapNewton::solve_model(const double residual)
  {
    remainder = derivative;
    project_on_free(remainder.data());
    std::fill(step.begin(), step.end(), 0.);
    std::fill(direction.begin(), direction.end(), 0.);

    const double reduction = std::min(.1, std::sqrt(residual));
    double       first = 0, last = 0;
    for (int k = 0;; ++k)
      {
        z = remainder;
        precondition(z.data());
        const auto [now] = weighted_sums<1>(problem, [this](const auto i, auto &sums) {
          sums[0] += z[i] * remainder[i];
        });
        if (k == 0)
          first = now;
        else if (!(now > reduction * reduction * first))
          return;
        const double beta = k == 0 ? 0. : now / last;
        last              = now;
        for (std::size_t i = 0; i < problem.size; ++i)
          direction[i] = -z[i] + beta * direction[i];
        const double work  = problem.apply(direction.data(), response.data());
        const auto [local] = weighted_sums<1>(problem, [this](const auto i, auto &sums) {
          const double d = direction[i];
          sums[0] += d * curvature[i] * d;
        });
        const bool is_concave = work + local <= 1e-10 * work;
        // At negative curvature go downhill; search() finds how far.
        const double length = is_concave ? 1. : now / (work + local);
        if (is_concave && k > 0)
          return;
        for (std::size_t i = 0; i < problem.size; ++i)
          {
            step[i] += length * direction[i];
            if (is_free(i))
              remainder[i] += length * (response[i] + curvature[i] * direction[i]);
          }
        if (is_concave)
          return;
        project_on_free(remainder.data());
      }
  }

  /** Go along the projected step until the energy falls. Return whether it did. */
  bool
  GapNewton::search()
  {
    const double before = energy();
    for (double length = 1; length > std::numeric_limits<double>::epsilon(); length *= .5)
      {
        double       *d = direction.data();
        const double *g = gap;
        for (std::size_t i = 0; i < problem.size; ++i)
          d[i] = g[i] + length * step[i];
        make_admissible(d);
        for (std::size_t i = 0; i < problem.size; ++i)
          d[i] -= g[i];
        const double work  = problem.apply(d, response.data());
        const auto [slope] = weighted_sums<1>(problem, [&](const auto i, auto &sums) {
          sums[0] += d[i] * derivative[i];
        });
        move(d, response.data(), work, 1.);
        step_length = length;
        if (energy() <=
            before + 1e-4 * std::min(slope, 0.) + energy_noise * std::abs(before))
          return true;
        move(d, response.data(), work, -1.);
      }
    return false;
  }
} // namespace strait
