// SPDX-License-Identifier: GPL-2.0-or-later
#include "hertz.h"

#include <cmath>

namespace strait::reference
{
  double
  Hertz::contact_radius() const
  {
    return std::cbrt(3 * force * radius / (4 * modulus));
  }

  double
  Hertz::indentation() const
  {
    const double a = contact_radius();
    return a * a / radius;
  }

  double
  Hertz::largest_pressure() const
  {
    const double a = contact_radius();
    return 3 * force / (2 * M_PI * a * a);
  }

  double
  Hertz::pressure(const double r) const
  {
    const double s = r / contact_radius();
    return s * s < 1 ? largest_pressure() * std::sqrt(1 - s * s) : 0.;
  }
} // namespace strait::reference
