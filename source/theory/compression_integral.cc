// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/theory/compression_integral.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // Below the smallest, W grows as −γ ln s up to a correction of the order s².
    constexpr double smallest_s = 1e-5, largest_s = 7.;
    constexpr int    n_steps = 4096;
    const double     first   = std::log(smallest_s);
    const double     step    = (std::log(largest_s) - first) / n_steps;
  } // namespace

  CompressionIntegral::CompressionIntegral(const double gamma_)
    : gamma(gamma_)
    , table(n_steps + 1, 0.)
  {
    // Simpson's rule, from the far end on.
    for (int k = n_steps - 1; k >= 0; --k)
      {
        const double left = first + k * step;
        table[k]          = table[k + 1] +
                   step / 6 *
                     (slope(std::exp(left)) + 4 * slope(std::exp(left + .5 * step)) +
                      slope(std::exp(left + step)));
      }
  }

  double
  CompressionIntegral::slope(const double s) const
  {
    const double error_function = std::erf(s);
    return (gamma + 3 * (1 - gamma) * error_function * error_function) * std::exp(-s * s);
  }

  double
  CompressionIntegral::operator()(const double s) const
  {
    if (s >= largest_s)
      return 0.;
    const double position = (std::log(s) - first) / step;
    if (position < 0)
      return table.front() - gamma * position * step;
    // Cubic through the four nearest entries.
    const int    k = std::clamp(static_cast<int>(position) - 1, 0, n_steps - 3);
    const double x = position - k;
    return table[k] * (1 - x) * (2 - x) * (3 - x) / 6 +
           table[k + 1] * x * (2 - x) * (3 - x) / 2 -
           table[k + 2] * x * (1 - x) * (3 - x) / 2 +
           table[k + 3] * x * (1 - x) * (2 - x) / 6;
  }

  double
  CompressionIntegral::largest()
  {
    return largest_s;
  }
} // namespace strait
