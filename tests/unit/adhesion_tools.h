// SPDX-License-Identifier: GPL-2.0-or-later
// What the tests of adhesion share: its methods, and the adhesive saddle.
#ifndef strait_tests_adhesion_tools_h
#define strait_tests_adhesion_tools_h

#include <strait/contact/adhesive_contact_solver.h>

#include "contact_tools.h"

namespace contact_tests
{
  inline constexpr AdhesionMethod all_methods[] = {AdhesionMethod::nonlinear_cg,
                                                   AdhesionMethod::newton_cg,
                                                   AdhesionMethod::gfmd};

  inline ContactParameters
  adhesive_parameters(const double         tolerance,
                      const AdhesionMethod method  = AdhesionMethod::nonlinear_cg,
                      const ContactControl control = ContactControl::load)
  {
    ContactParameters parameters  = contact_parameters(tolerance, control);
    parameters.maximum_iterations = 5000;
    parameters.adhesion.enabled   = true;
    parameters.adhesion.method    = method;
    return parameters;
  }

  /** γ0 = 0.1 E*Δ and the range of a Tabor number, for the square saddle. */
  inline AdhesionLaw
  saddle_law(const double tabor, const AdhesionShape shape = AdhesionShape::exponential)
  {
    return {.1, std::cbrt(.035823 * .01) / tabor, shape};
  }

  inline AdhesiveContactSolver
  saddle_solver(const ContactParameters &parameters,
                const double             tabor,
                const int                n     = 64,
                const AdhesionShape      shape = AdhesionShape::exponential)
  {
    return {parameters,
            saddle_law(tabor, shape),
            AdhesiveStart::without_adhesion,
            saddle_heights(n)};
  }
} // namespace contact_tests

#endif
