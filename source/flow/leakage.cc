// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/leakage.h>

#include <cmath>

namespace strait
{
  double
  effective_gap(const Leakage &leakage, const FluidParameters &fluid)
  {
    return std::cbrt(12. * fluid.viscosity * leakage.rate * leakage.aspect /
                     (fluid.inlet_pressure - fluid.outlet_pressure));
  }
} // namespace strait
