// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/theory/closing_law.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace strait
{
  ClosingLaw
  ClosingLaw::fit(const std::vector<Slope> &leak_rate)
  {
    const auto excess = [&](const double constant) {
      const ClosingLaw law{constant};
      double           sum = 0;
      for (const Slope &slope : leak_rate)
        sum += law.at(slope.reduced_load).leak_rate - slope.exponent;
      return sum;
    };
    // From the constant at which the largest ε would have no Λ to one at which the
    // exponents are those of the limit: they fall all the way.
    double least = -std::numeric_limits<double>::infinity();
    for (const Slope &slope : leak_rate)
      least = std::max(least, .5 * std::log(slope.reduced_load));
    const double most = 1. / std::numeric_limits<float>::epsilon();
    if (leak_rate.empty() || !(excess(least) > 0) || !(excess(most) < 0))
      return {std::numeric_limits<double>::quiet_NaN()};
    namespace tools                = boost::math::tools;
    std::uintmax_t max_evaluations = 200;
    const auto [lower, upper]      = tools::toms748_solve(
      excess, least, most, tools::eps_tolerance<double>(40), max_evaluations);
    return {.5 * (lower + upper)};
  }

  ClosingLaw::Exponents
  ClosingLaw::at(const double reduced_load) const
  {
    const double lambda = 1. + std::sqrt(constant - .5 * std::log(reduced_load));
    const double gap    = 1. + .5 / lambda;
    const double width  = 1. / (2. + std::pow(lambda, -2));
    return {gap, width, .5 * gap, 2.5 * gap + width};
  }
} // namespace strait
