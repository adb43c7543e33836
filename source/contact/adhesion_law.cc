// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/adhesion_law.h>

#include <cmath>

namespace strait
{
  namespace
  {
    /** f, −f' and f'' of a shape at s = g/z0. */
    struct Shape
    {
      double value, slope, curvature;
    };

    /** f = exp(−s). */
    struct Exponential
    {
      static Shape
      at(const double s)
      {
        const double f = std::exp(-s);
        return {f, f, f};
      }
    };

    /**
     * f = 1/(1 + s)²: van der Waals forces between half-spaces at the distance D = z0 +
     * g, −A/(12π D²) with Hamaker's constant A = 12π γ0 z0² (Israelachvili,
     * Intermolecular and Surface Forces, 2011). It is the attractive part of the 3-9 law
     * between surfaces that Lennard-Jones' potential gives, with the hard wall in place
     * of the repulsive one.
     */
    struct VanDerWaals
    {
      static Shape
      at(const double s)
      {
        const double u = 1 / (1 + s), square = u * u;
        return {square, 2 * square * u, 6 * square * square};
      }
    };

    template <class Kind>
    AdhesionLaw::Values
    value_of(const AdhesionLaw &law, const double gap)
    {
      const double s     = gap / law.range;
      const Shape  f     = Kind::at(s);
      const double slope = law.surface_energy / law.range;
      return {-law.surface_energy * f.value,
              slope * f.slope,
              -slope / law.range * f.curvature};
    }

    template <class Kind>
    double
    values_of(const AdhesionLaw &law,
              const std::size_t  n,
              const double      *gap,
              double            *traction,
              double            *curvature)
    {
      // Copies, for all the compiler knows a write to a field might change the law.
      const AdhesionLaw         local      = law;
      const AdhesionLaw::Values in_contact = value_of<Kind>(local, 0.);
      double                    energy     = 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          const AdhesionLaw::Values here =
            gap[i] > 0 ? value_of<Kind>(local, gap[i]) : in_contact;
          energy += here.energy;
          traction[i]  = here.traction;
          curvature[i] = here.curvature;
        }
      return energy;
    }
  } // namespace

  AdhesionLaw::Values
  AdhesionLaw::at(const double gap) const
  {
    Values values{};
    values.energy = evaluate(1, &gap, &values.traction, &values.curvature);
    return values;
  }

  double
  AdhesionLaw::evaluate(const std::size_t n,
                        const double     *gap,
                        double           *traction,
                        double           *curvature) const
  {
    switch (shape)
      {
        case AdhesionShape::exponential:
          return values_of<Exponential>(*this, n, gap, traction, curvature);
        case AdhesionShape::van_der_waals:
          return values_of<VanDerWaals>(*this, n, gap, traction, curvature);
      }
    return 0;
  }
} // namespace strait
