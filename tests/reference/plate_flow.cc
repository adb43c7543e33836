// SPDX-License-Identifier: GPL-2.0-or-later
#include "plate_flow.h"

#include <cmath>

namespace strait::reference
{
  double
  cubed_gap_along_wave(const double mean_gap, const double epsilon)
  {
    return std::pow(mean_gap, 3) * std::pow(1 - epsilon * epsilon, 2.5) /
           (1 + epsilon * epsilon / 2);
  }

  double
  cubed_gap_across_wave(const double mean_gap, const double epsilon)
  {
    return std::pow(mean_gap, 3) * (1 + 1.5 * epsilon * epsilon);
  }

  double
  cubed_gap_of_product(const double mean_gap,
                       const double epsilon_along,
                       const double epsilon_across)
  {
    return cubed_gap_along_wave(mean_gap, epsilon_along) *
           cubed_gap_across_wave(1., epsilon_across);
  }

  double
  checkerboard_conductivity(const double first, const double second)
  {
    return std::sqrt(first * second);
  }

  double
  conductivity_around_discs(const double area_fraction)
  {
    const double f  = area_fraction;
    const double f4 = std::pow(f, 4);
    const double f8 = f4 * f4;
    return 1 - 2 * f / (1 + f - 0.305827 * f4 / (1 - 1.402958 * f8) - 0.013362 * f8);
  }

  double
  ParabolicConstriction::resistance(const double half_length) const
  {
    // ∫(1 − y²/w²)³ dy = (32/35) w, and ∫(1 + x²/l²)⁻³ dx is elementary.
    const double half_pi  = std::acos(0.);
    double       integral = 3. / 8. * half_pi; // over 0 < x/l < t = ∞
    const double t        = half_length / length;
    if (std::isfinite(t))
      {
        const double s = 1 + t * t;
        integral       = t / (4 * s * s) + 3 * t / (8 * s) + 3. / 8. * std::atan(t);
      }
    return 12 * viscosity * length / (width * std::pow(gap, 3)) * 35. / 32. * 2 *
           integral;
  }
} // namespace strait::reference
