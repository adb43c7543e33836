// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/leakage.h>
#include <strait/interface/rarefied_gas.h>

#include <cmath>

namespace strait
{
  double
  effective_gap(const Leakage &leakage, const FluidParameters &fluid)
  {
    const double drop = fluid.inlet_pressure - fluid.outlet_pressure;
    const double viscous =
      std::cbrt(12. * fluid.viscosity * leakage.rate * leakage.aspect / drop);
    if (fluid.rarefaction == Rarefaction::none || leakage.rate == 0.)
      return viscous;
    // A rarefied gas needs less of a gap, whose cube falls short of the other's by what
    // its mobility is more: each round comes closer from above, until rounding is left.
    const RarefiedGas gas(fluid);
    double            gap = viscous, before = 0.;
    do
      {
        before = gap;
        gap    = viscous *
              std::cbrt(drop * fluid.mean_pressure() /
                        gas.drive(gap, fluid.outlet_pressure, fluid.inlet_pressure));
      }
    while (gap < before);
    return gap;
  }
} // namespace strait
