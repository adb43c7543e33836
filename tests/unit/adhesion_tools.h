// SPDX-License-Identifier: GPL-2.0-or-later
// What the tests of adhesion share.
#ifndef strait_tests_adhesion_tools_h
#define strait_tests_adhesion_tools_h

#include <strait/contact/adhesion_law.h>

#include <cmath>

#include "contact_tools.h"

namespace contact_tests
{
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

  /** The shapes f(g/z0), with their derivatives worked out by hand. */
  struct ClosedForm
  {
    AdhesionShape shape;
    double (*value)(double);
    double (*slope)(double);
    double (*curvature)(double);
  };

  inline const ClosedForm closed_forms[] = {
    {AdhesionShape::exponential,
     [](const double s) { return std::exp(-s); },
     [](const double s) { return -std::exp(-s); },
     [](const double s) { return std::exp(-s); }},
    {AdhesionShape::van_der_waals,
     [](const double s) { return std::pow(1 + s, -2); },
     [](const double s) { return -2 * std::pow(1 + s, -3); },
     [](const double s) { return 6 * std::pow(1 + s, -4); }}};
} // namespace contact_tests

#endif
