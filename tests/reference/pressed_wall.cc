// SPDX-License-Identifier: GPL-2.0-or-later
#include "pressed_wall.h"

#include <cmath>

namespace strait
{
  double
  clausen(const double theta)
  {
    // In [−π, π] the series of −∫ ln(2 sin(t/2)) dt converges like (θ/2π)^2k. Its
    // coefficients are |B_2k|/(2k (2k+1)!), with Bernoulli numbers B_2k, that is
    // 2 ζ(2k)/((2π)^2k 2k (2k+1)).
    const double x = std::remainder(theta, 2. * M_PI);
    if (x == 0)
      return 0;
    const double ratio  = x * x / (4. * M_PI * M_PI);
    double       result = x - x * std::log(std::abs(x));
    double       power  = 1.;
    for (int k = 1; k < 40; ++k)
      {
        power *= ratio;
        result += x * 2. * std::riemann_zeta(2. * k) * power / (2. * k * (2. * k + 1.));
      }
    return result;
  }

  double
  PressedWall::parameter() const
  {
    return inlet_pressure * length / (M_PI * M_PI * contact_modulus * mean_gap);
  }

  double
  PressedWall::gap_change(const double x) const
  {
    return parameter() * mean_gap * clausen(2. * M_PI * x / length);
  }

  double
  PressedWall::leak_rate_ratio() const
  {
    const double mean_square = std::pow(M_PI, 4) / 180.;
    return 1. - 6. * parameter() * parameter() * mean_square;
  }
} // namespace strait
