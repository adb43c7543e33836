// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_adhesion_law_h
#define strait_contact_adhesion_law_h

#include <cmath>

namespace strait
{
  /**
   * The energy of adhesion γ(g) = −γ0 exp(−g/z0) per area at the gap g >= 0. Without
   * adhesion γ0 = 0.
   */
  struct AdhesionLaw
  {
    double surface_energy = 0; // γ0
    double range          = 1; // z0

    /** γ'(g) > 0: the attraction per area. It vanishes beyond 40 ranges. */
    double
    traction(const double gap) const
    {
      return gap < 40 * range ? surface_energy / range * std::exp(-gap / range) : 0.;
    }

    /** γ where γ' is @p traction. */
    double
    energy(const double traction) const
    {
      return -range * traction;
    }

    /** γ'' where γ' is @p traction. */
    double
    curvature(const double traction) const
    {
      return -traction / range;
    }
  };
} // namespace strait

#endif
