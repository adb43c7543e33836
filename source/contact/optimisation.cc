// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisation.h>

namespace strait
{
  ContactConstraint
  ContactConstraint::mean_pressure(const double pressure)
  {
    return {true, pressure};
  }

  ContactConstraint
  ContactConstraint::rigid_displacement(const double displacement)
  {
    return {false, displacement};
  }
} // namespace strait
