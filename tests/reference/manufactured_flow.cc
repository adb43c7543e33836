// SPDX-License-Identifier: GPL-2.0-or-later
#include "manufactured_flow.h"

#include <cmath>

namespace strait::reference::manufactured_flow
{
  namespace
  {
    std::array<double, 2>
    gap_gradient(const double x, const double y)
    {
      return {{-M_PI * std::sin(2 * M_PI * x) * std::cos(2 * M_PI * y),
               -M_PI * std::cos(2 * M_PI * x) * std::sin(2 * M_PI * y)}};
    }

    double
    pressure_laplacian(const double x, const double y)
    {
      return -0.5 * M_PI * M_PI * std::sin(M_PI * x) * std::cos(2 * M_PI * y);
    }
  } // namespace

  double
  gap(const double x, const double y)
  {
    return 1 + 0.5 * std::cos(2 * M_PI * x) * std::cos(2 * M_PI * y);
  }

  double
  conductivity(const double x, const double y)
  {
    return std::pow(gap(x, y), 3) / 12;
  }

  double
  pressure(const double x, const double y)
  {
    return 1 - x + 0.1 * std::sin(M_PI * x) * std::cos(2 * M_PI * y);
  }

  std::array<double, 2>
  pressure_gradient(const double x, const double y)
  {
    return {{-1 + 0.1 * M_PI * std::cos(M_PI * x) * std::cos(2 * M_PI * y),
             -0.2 * M_PI * std::sin(M_PI * x) * std::sin(2 * M_PI * y)}};
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
