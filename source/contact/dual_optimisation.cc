// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/dual_optimisation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  WithinLimits
  within_limits(const DualProblem               &problem,
                const ContactConstraint         &constraint,
                const std::vector<std::uint8_t> &is_active,
                const double                    *pressure)
  {
    if (!constraint.is_limited())
      {
        const auto [mean] = weighted_sums<1>(problem, [=](const auto i, auto &sums) {
          sums[0] += pressure[i] > 0 ? pressure[i] : 0.;
        });
        return {0., constraint.rescale(mean), constraint.limit, false};
      }

    const double limit = constraint.limit, goal = constraint.value;
    const auto [moving, held] = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      sums[0] += is_active[i] ? 1. : 0.;
      sums[1] += is_active[i] ? 0. : pressure[i];
    });
    const bool   shifts_all   = held > goal || held + limit * moving < goal;
    WithinLimits shifted      = {0., 1., limit, shifts_all};

    // The mean grows with the shift, from its value with 0 at the points that move to
    // that with the limit at all of them.
    double lower = 0., upper = limit;
    for (std::size_t i = 0; i < problem.size; ++i)
      {
        lower = std::min(lower, -pressure[i]);
        upper = std::max(upper, limit - pressure[i]);
      }
    lower = minimum(problem.communicator, lower);
    upper = maximum(problem.communicator, upper);
    while (true)
      {
        const auto [mean,
                    free]   = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
          const double value = shifted(pressure[i], is_active[i] != 0);
          sums[0] += value;
          sums[1] += (shifts_all || is_active[i]) && value > 0 && value < limit ? 1. : 0.;
        });
        const double excess = mean - goal;
        // Rounding allows no better shift, and Newton's method doubles the digits.
        if (std::abs(excess) <= 64 * std::numeric_limits<double>::epsilon() * goal)
          break;
        (excess > 0 ? upper : lower) = shifted.shift;
        const double newton          = shifted.shift - excess / free;
        const bool   is_inside       = newton > lower && newton < upper;
        const double next            = is_inside ? newton : .5 * (lower + upper);
        if (next == shifted.shift) // no number lies between
          break;
        shifted.shift = next;
      }
    return shifted;
  }
} // namespace strait
