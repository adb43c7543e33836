// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/slow_approach.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  std::optional<Passage>
  approach_slowly(Passage                            known,
                  const double                       tolerance,
                  const std::function<bool(double)> &is_lost)
  {
    constexpr double farthest  = 1e6;
    const double     direction = known.beyond > known.before ? 1. : -1.;
    const double     typical   = std::max(known.before, known.beyond);

    // Where the state was when it was lost at the end that is known.
    double     lost_from = std::numeric_limits<double>::quiet_NaN();
    const auto ask       = [&](const double value) {
      const bool lost = is_lost(value);
      if (lost)
        {
          lost_from    = known.before;
          known.beyond = value;
        }
      else
        known.before = value;
      return lost;
    };
    const auto is_near = [&](const double from) {
      return std::abs(known.beyond - from) <=
             tolerance * std::max(known.beyond, known.before);
    };

    while (true)
      {
        while (!is_near(known.before))
          ask(.5 * (known.before + known.beyond));
        if (is_near(lost_from) || ask(known.beyond))
          return known;
        double step = direction * tolerance * known.before;
        while (!ask(std::max(known.before + step, .5 * known.before)))
          {
            if (known.before > farthest * typical || farthest * known.before < typical)
              return {};
            step *= 2;
          }
      }
  }
} // namespace strait
