// SPDX-License-Identifier: GPL-2.0-or-later
// Shared by the tests of adhesion: methods and parameters.
#pragma once

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
} // namespace contact_tests
