// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/theory/effective_medium.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace strait
{
  double
  effective_conductivity(const std::vector<MediumPart> &medium, const double n)
  {
    double blocked = 0, open = 0;
    double least = std::numeric_limits<double>::max(), most = 0;
    for (const auto &[share, conductivity] : medium)
      if (!(conductivity > 0))
        blocked += share;
      else if (share > 0)
        {
          open += share;
          least = std::min(least, conductivity);
          most  = std::max(most, conductivity);
        }
    blocked /= blocked + open;
    if (!(open > 0) || blocked >= 1 - 1 / n)
      return 0.;

    // Between the results for the least and the most conductivity throughout.
    const double alone   = 1 - blocked * n / (n - 1);
    const auto   balance = [&](const double log_effective) {
      const double effective = std::exp(log_effective);
      double       sum       = 0;
      for (const auto &[share, conductivity] : medium)
        if (share > 0)
          sum +=
            share * (conductivity - effective) / (conductivity + (n - 1) * effective);
      return sum;
    };
    // Rounding puts the root outside if (nearly) all that conducts does so alike.
    const double from = std::log(alone * least), to = std::log(alone * most);
    if (!(balance(from) > 0))
      return alone * least;
    if (!(balance(to) < 0))
      return alone * most;
    std::uintmax_t most_steps = 200;
    const auto [low, high]    = boost::math::tools::toms748_solve(
      balance, from, to, boost::math::tools::eps_tolerance<double>(), most_steps);
    return std::exp(.5 * (low + high));
  }

  double
  effective_cubed_gap(const GapDistribution &gaps, const double n)
  {
    std::vector<MediumPart> medium = {{gaps.contact_area, 0.}};
    for (std::size_t k = 0; k < gaps.gaps.size(); ++k)
      medium.push_back({gaps.shares[k], std::pow(gaps.gaps[k], 3)});
    return effective_conductivity(medium, n);
  }

  double
  dimension_parameter(const double blocked)
  {
    return 1 / (1 - blocked);
  }
} // namespace strait
