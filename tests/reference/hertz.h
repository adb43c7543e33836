// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait::reference
{
  /**
   * Hertzian contact of a sphere of radius R with an elastic half-space of
   * contact modulus E* under the force F (Johnson, Contact Mechanics, 1985).
   */
  struct Hertz
  {
    double force;
    double radius;
    double modulus;

    /** a = (3FR/(4E*))^{1/3}. */
    double contact_radius() const;

    /** The approach of distant points, δ = a²/R. */
    double indentation() const;

    /** p_max = 3F/(2πa²), at the centre. */
    double largest_pressure() const;

    /** p_max √(1 − r²/a²) at the distance @p r from the centre, 0 outside. */
    double pressure(double r) const;
  };
} // namespace strait::reference
