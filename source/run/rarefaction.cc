// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/rarefaction.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  double
  mean_free_path_times_pressure(const Scene &scene)
  {
    constexpr double       gas_constant = 8.314462618; // J/(mol K)
    const FluidParameters &fluid        = scene.fluid;
    const double           speed =
      std::sqrt(.5 * M_PI * gas_constant * fluid.temperature / fluid.molar_mass); // m/s
    return fluid.viscosity * speed * seconds_in(scene.units.time).value_or(1.) /
           scene.units.length_in_metres();
  }

  KnudsenNumbers
  knudsen_numbers(const FlowPath &path, const Scene &scene)
  {
    const double constant    = mean_free_path_times_pressure(scene);
    const double inlet       = scene.fluid.inlet_pressure;
    const double outlet      = scene.fluid.outlet_pressure;
    const auto   pressure_at = [&](const std::size_t k) {
      const double fraction = path.resistances[k] / path.resistance();
      return std::sqrt((1. - fraction) * inlet * inlet + fraction * outlet * outlet);
    };
    const auto     narrowest = std::min_element(path.gaps.begin(), path.gaps.end());
    KnudsenNumbers result;
    result.at_throat =
      constant / (*narrowest * pressure_at(narrowest - path.gaps.begin()));
    // The mean of λ/g over the resistance r is Σ c/g ∫ dr/p, with dr/p = −2 dp/(p_in² −
    // p_out²).
    for (std::size_t k = 1; k < path.gaps.size(); ++k)
      result.mean += .5 * constant * (1. / path.gaps[k - 1] + 1. / path.gaps[k]) * 2. *
                     (pressure_at(k - 1) - pressure_at(k)) /
                     (inlet * inlet - outlet * outlet);
    return result;
  }
} // namespace strait
