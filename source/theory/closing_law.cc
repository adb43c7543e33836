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
        sum += law.leak_rate_exponent(slope.reduced_load) - slope.exponent;
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

  double
  ClosingLaw::lambda(const double reduced_load) const
  {
    // In this order an unknown constant stays unknown.
    return 1. + std::sqrt(std::max(constant - .5 * std::log(reduced_load), 0.));
  }

  double
  ClosingLaw::gap_exponent(const double reduced_load) const
  {
    return 1. + .5 / lambda(reduced_load);
  }

  double
  ClosingLaw::width_exponent(const double reduced_load) const
  {
    return 1. / (2. + std::pow(lambda(reduced_load), -2));
  }

  double
  ClosingLaw::length_exponent(const double reduced_load) const
  {
    return .5 * gap_exponent(reduced_load);
  }

  double
  ClosingLaw::leak_rate_exponent(const double reduced_load) const
  {
    return 2.5 * gap_exponent(reduced_load) + width_exponent(reduced_load);
  }
} // namespace strait
