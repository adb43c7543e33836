// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/trapped_fluid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  double
  volume_at(const FeedbackParameters &parameters,
            const TrappedRegion      &region,
            const double              pressure)
  {
    const double modulus = parameters.bulk_modulus, slope = parameters.bulk_modulus_slope;
    switch (parameters.trapped_fluid)
      {
        case TrappedFluidLaw::compressible:
          return region.volume * (slope == 0.
                                    ? std::exp(-(pressure - region.pressure) / modulus)
                                    : std::pow((modulus + slope * pressure) /
                                                 (modulus + slope * region.pressure),
                                               -1. / slope));
        case TrappedFluidLaw::gas:
          return region.volume * region.pressure /
                 std::max(pressure, std::numeric_limits<double>::min());
        case TrappedFluidLaw::incompressible:
        case TrappedFluidLaw::drained:
          break;
      }
    return region.volume;
  }

  double
  pressure_to_hold(const FeedbackParameters &parameters,
                   const TrappedRegion      &region,
                   const double              volume,
                   const double              pressure)
  {
    // A gas without pressure has no mass. A liquid cavitates at its vapour pressure.
    const bool   is_gas = parameters.trapped_fluid == TrappedFluidLaw::gas;
    const double least  = is_gas ? 0. : parameters.vapour_pressure;
    const auto   excess = [&](const double p) {
      return volume + region.compliance * (p - pressure) -
             volume_at(parameters, region, p);
    };
    if (excess(least) >= 0.)
      return least;
    // As the pressure rises, walls widen and the fluid shrinks: one pressure fits.
    double lower = least;
    double upper = std::max({pressure, region.pressure, least});
    upper += std::max(0.,
                      volume_at(parameters, region, upper) - volume -
                        region.compliance * (upper - pressure)) /
             region.compliance;
    for (double middle = .5 * (lower + upper); lower < middle && middle < upper;
         middle        = .5 * (lower + upper))
      (excess(middle) < 0. ? lower : upper) = middle;
    return upper;
  }
} // namespace strait
