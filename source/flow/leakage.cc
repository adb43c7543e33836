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
    // its mobility is more; each round divides the error by a factor of 1.5 to 3, and
    // after that many none is left.
    const RarefiedGas gas(fluid);
    double            gap = viscous;
    for (int round = 0; round < 100; ++round)
      gap =
        viscous * std::cbrt(drop * fluid.mean_pressure() /
                            gas.drive(gap, fluid.outlet_pressure, fluid.inlet_pressure));
    return gap;
  }
} // namespace strait
