// SPDX-License-Identifier: GPL-2.0-or-later
#include "manufactured_flow.h"

#include <cmath>

namespace strait::reference::manufactured_flow
{
  namespace
  {
    const double pi = std::acos(-1.);

    std::array<double, 2>
    gap_gradient(const double x, const double y)
    {
      return {{-pi * std::sin(2 * pi * x) * std::cos(2 * pi * y),
               -pi * std::cos(2 * pi * x) * std::sin(2 * pi * y)}};
    }

    double
    pressure_laplacian(const double x, const double y)
    {
      return -0.5 * pi * pi * std::sin(pi * x) * std::cos(2 * pi * y);
    }
  } // namespace

  double
  gap(const double x, const double y)
  {
    return 1 + 0.5 * std::cos(2 * pi * x) * std::cos(2 * pi * y);
  }

  double
  conductivity(const double x, const double y)
  {
    return std::pow(gap(x, y), 3) / 12;
  }

  double
  pressure(const double x, const double y)
  {
    return 1 - x + 0.1 * std::sin(pi * x) * std::cos(2 * pi * y);
  }

  std::array<double, 2>
  pressure_gradient(const double x, const double y)
  {
    return {{-1 + 0.1 * pi * std::cos(pi * x) * std::cos(2 * pi * y),
             -0.2 * pi * std::sin(pi * x) * std::sin(2 * pi * y)}};
  }

  double
  source(const double x, const double y)
  {
    // ∇K = (g²/4) ∇g
    const auto   slope = gap_gradient(x, y);
    const auto   drop  = pressure_gradient(x, y);
    const double g     = gap(x, y);
    return -g * g / 4 * (slope[0] * drop[0] + slope[1] * drop[1]) -
           conductivity(x, y) * pressure_laplacian(x, y);
  }
} // namespace strait::reference::manufactured_flow
