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
    Shape
    exponential(const double s)
    {
      const double f = std::exp(-s);
      return {f, f, f};
    }

    /**
     * f = 1/(1 + s)²: van der Waals forces between half-spaces at the distance D = z0 +
     * g, −A/(12π D²) with Hamaker's constant A = 12π γ0 z0² (Israelachvili,
     * Intermolecular and Surface Forces, 2011). It is the attractive part of the 3-9 law
     * between surfaces that Lennard-Jones' potential gives, with the hard wall in place
     * of the repulsive one.
     */
    Shape
    van_der_waals(const double s)
    {
      const double u = 1 / (1 + s), square = u * u;
      return {square, 2 * square * u, 6 * square * square};
    }

    template <Shape (*shape)(double)>
    double
    values_of(const AdhesionLaw &law,
              const std::size_t  n,
              const double      *gap,
              double            *traction,
              double            *curvature)
    {
      // Copies, for all the compiler knows a write to a field might change the law.
      const double gamma = law.surface_energy, range = law.range, slope = gamma / range;
      const Shape  in_contact = shape(0.);
      double       energy     = 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          const Shape f = gap[i] > 0 ? shape(gap[i] / range) : in_contact;
          energy += -gamma * f.value;
          traction[i]  = slope * f.slope;
          curvature[i] = -slope / range * f.curvature;
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
    const auto values = shape == AdhesionShape::exponential ? values_of<exponential>
                                                            : values_of<van_der_waals>;
    return values(*this, n, gap, traction, curvature);
  }
} // namespace strait
