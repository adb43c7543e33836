// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/moment_set.h>

#include <boost/math/special_functions/binomial.hpp>

#include <algorithm>
#include <cmath>

namespace strait
{
  MomentSet::MomentSet(const unsigned int degree)
    : element_degree(degree)
  {
    const int p = static_cast<int>(degree);
    for (auto &row : positions)
      row.fill(-1);
    for (int a = 0; a <= 2 * p; ++a)
      for (int b = 0; b <= 2 * p; ++b)
        if (std::min(a, b) <= 2 * p - 2)
          {
            positions[a][b] = static_cast<int>(exponents.size());
            exponents.push_back({a, b});
          }

    // A child's coordinate x lies at (right + x)/2 of its parent: expand the power.
    const auto coefficient = [](const int n, const int k, const int offset) {
      return offset == 0 && k < n ? 0. : boost::math::binomial_coefficient<double>(n, k);
    };
    for (int upper = 0; upper < 2; ++upper)
      for (int right = 0; right < 2; ++right)
        for (int to = 0; to < size(); ++to)
          for (int from = 0; from < size(); ++from)
            {
              const auto [a, b] = exponents[to];
              const auto [s, t] = exponents[from];
              if (s > a || t > b)
                continue;
              const double factor = coefficient(a, s, right) * coefficient(b, t, upper) *
                                    .25 * std::ldexp(1., -(a + b));
              if (factor != 0)
                transfers[2 * upper + right].push_back({to, from, factor});
            }
  }

  void
  MomentSet::add_point(double      *moments,
                       const double x,
                       const double y,
                       const double weight) const
  {
    std::array<double, 5> x_power{{1.}}, y_power{{1.}};
    for (unsigned int k = 1; k <= 2 * element_degree; ++k)
      {
        x_power[k] = x_power[k - 1] * x;
        y_power[k] = y_power[k - 1] * y;
      }
    for (int k = 0; k < size(); ++k)
      moments[k] += weight * x_power[exponents[k].a] * y_power[exponents[k].b];
  }
} // namespace strait
