// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/adhesion_law.h>

#include <cmath>

namespace strait
{
  namespace
  {
    using Values = AdhesionLaw::Values;

    /** f, −f' and f'' of f = exp(−s) at s = g/z0. */
    Values
    exponential(const double s)
    {
      const double f = std::exp(-s);
      return {f, f, f};
    }

    /**
     * f, −f' and f'' of f = 1/(1 + s)²: the energy of van der Waals forces between
     * half-spaces at the distance D = z0 + g, −A/(12π D²), with Hamaker's constant
     * A = 12π γ0 z0² (Israelachvili, Intermolecular and Surface Forces, 2011). It is the
     * attractive part of the 3-9 law that the Lennard-Jones potential gives for surfaces;
     * the hard wall replaces the repulsive part.
     */
    Values
    van_der_waals(const double s)
    {
      const double u = 1 / (1 + s), square = u * u;
      return {square, 2 * square * u, 6 * square * square};
    }
  } // namespace

  AdhesionLaw::Values
  AdhesionLaw::at(const double gap) const
  {
    const auto [f, slope, curvature] = shape == AdhesionShape::exponential
                                         ? exponential(gap / range)
                                         : van_der_waals(gap / range);
    const double largest             = surface_energy / range;
    return {-surface_energy * f, largest * slope, -largest / range * curvature};
  }

  double
  AdhesionLaw::evaluate(const std::size_t n,
                        const double     *gap,
                        double           *traction,
                        double           *curvature) const
  {
    // A copy, because for all the compiler knows a write to a field might change the law.
    const AdhesionLaw law        = *this;
    const Values      in_contact = law.at(0.);
    double            energy     = 0;
    for (std::size_t i = 0; i < n; ++i)
      {
        const Values here = gap[i] > 0 ? law.at(gap[i]) : in_contact;
        energy += here.energy;
        traction[i]  = here.traction;
        curvature[i] = here.curvature;
      }
    return energy;
  }
} // namespace strait
