// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/leakage.h>
#include <strait/interface/rarefied_gas.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  double
  effective_gap(const Leakage &leakage, const FluidParameters &fluid)
  {
    const double drop = fluid.inlet_pressure - fluid.outlet_pressure;
    if (drop == 0.)
      return std::numeric_limits<double>::quiet_NaN(); // any gap would do
    if (leakage.rate == 0.)
      return 0.;
    const double viscous =
      std::cbrt(12. * fluid.viscosity * leakage.rate * leakage.aspect / drop);
    if (fluid.rarefaction == Rarefaction::none)
      return viscous;
    // A rarefied gas needs a smaller gap: its cube is smaller by the factor by which the
    // mobility is larger. Each round comes closer from above, down to rounding.
    const RarefiedGas gas(fluid);
    const auto [low, high] = std::minmax(fluid.inlet_pressure, fluid.outlet_pressure);
    double gap = viscous, before = 0.;
    do
      {
        before = gap;
        gap =
          viscous * std::cbrt(fluid.mean_pressure() / gas.mean_mobility(gap, low, high));
      }
    while (gap < before);
    return gap;
  }
} // namespace strait
