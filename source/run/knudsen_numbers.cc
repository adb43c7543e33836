// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/rarefied_gas.h>
#include <strait/run/validity.h>

#include <cmath>

namespace strait
{
  KnudsenNumbers
  knudsen_numbers(const FlowPath &path, const Scene &scene)
  {
    // The mean free path times the pressure depends on the temperature only.
    const double constant    = RarefiedGas(scene.fluid).knudsen_number(1., 1.);
    const double inlet       = scene.fluid.inlet_pressure;
    const double outlet      = scene.fluid.outlet_pressure;
    const auto   pressure_at = [inlet, outlet](const double part) { // of the resistance
      return std::sqrt((1. - part) * inlet * inlet + part * outlet * outlet);
    };
    const auto pressure = [&](const std::size_t k) {
      return pressure_at(path.resistances[k] / path.resistance());
    };
    KnudsenNumbers result;
    result.at_throat =
      constant / (path.bottleneck_gap * pressure_at(path.part_before_throat()));
    // The mean of λ/g over the resistance r is Σ c/g ∫ dr/p, with dr/p = −2 dp/(p_in² −
    // p_out²).
    for (std::size_t k = 1; k < path.gaps.size(); ++k)
      result.mean += .5 * constant * (1. / path.gaps[k - 1] + 1. / path.gaps[k]) * 2. *
                     (pressure(k - 1) - pressure(k)) / (inlet * inlet - outlet * outlet);
    return result;
  }
} // namespace strait
