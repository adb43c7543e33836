// SPDX-License-Identifier: GPL-2.0-or-later
#include "manufactured_flow.h"

#include <cmath>

namespace strait::reference::manufactured_flow
{
  namespace
  {
    double
    root(const double x, const double y)
    {
      return 1 + .5 * std::cosh(2 * M_PI * x - M_PI) / std::cosh(M_PI) *
                   std::cos(2 * M_PI * y);
    }
  } // namespace

  double
  conductivity(const double x, const double y)
  {
    return root(x, y) * root(x, y);
  }

  double
  gap(const double x, const double y)
  {
    return std::cbrt(12 * conductivity(x, y));
  }

  double
  pressure(const double x, const double y)
  {
    const double h =
      1 - x +
      .5 * std::sinh(2 * M_PI * (1 - x)) / std::sinh(2 * M_PI) * std::cos(2 * M_PI * y);
    return h / root(x, y);
  }
} // namespace strait::reference::manufactured_flow
