// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/slow_approach.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  Passage
  approach_slowly(Passage                            known,
                  const double                       tolerance,
                  const std::function<bool(double)> &is_lost)
  {
    constexpr double negligible = 1e-6;
    const double     direction  = known.beyond > known.before ? 1. : -1.;
    const double     least      = negligible * known.before;
    const auto       bisect     = [&]() {
      while (std::abs(known.beyond - known.before) >
             tolerance * std::max(known.beyond, known.before))
        {
          const double between = .5 * (known.before + known.beyond);
          (is_lost(between) ? known.beyond : known.before) = between;
        }
    };
    bisect();
    while (!is_lost(known.beyond) && known.beyond > least)
      {
        double step = direction * tolerance * known.beyond;
        do
          {
            known.before = known.beyond;
            known.beyond = std::max(known.beyond + step, .5 * known.before);
            step *= 2;
          }
        while (!is_lost(known.beyond) && known.beyond > least);
        bisect();
      }
    return known;
  }
} // namespace strait
