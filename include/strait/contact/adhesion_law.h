// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>

#include <cstddef>

namespace strait
{
  /**
   * The energy of adhesion per area, γ(g) = −γ0 f(g/z0) at the gap g >= 0. The shape f is
   * convex and falls from f(0) = 1 to 0, so that the attraction γ'(g) > 0 and the
   * magnitude of its slope are largest in contact. The class is a plain value: γ0, z0 and
   * the name of the shape. Only adhesion_law.cc knows the shapes themselves.
   */
  struct AdhesionLaw
  {
    double        surface_energy = 0; // γ0; 0: no adhesion
    double        range          = 1; // z0
    AdhesionShape shape          = AdhesionShape::exponential;

    /** The law at one gap. */
    struct Values
    {
      double energy;    // γ
      double traction;  // γ'
      double curvature; // γ''
    };
    /** Return the law at @p gap >= 0. */
    Values at(double gap) const;

    /**
     * Write γ' and γ'' at the @p n values of @p gap, all >= 0, to @p traction and
     * @p curvature. Return the sum of γ over them.
     */
    double
    evaluate(std::size_t n, const double *gap, double *traction, double *curvature) const;
  };
} // namespace strait
