// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>

#include <cmath>

namespace strait
{
  /** Helium at 293.15 K that flows from 2 bar to @p outlet_pressure, in SI units. */
  inline FluidParameters
  helium(const Rarefaction rarefaction, const double outlet_pressure = 0.)
  {
    FluidParameters fluid;
    fluid.is_gas          = true;
    fluid.rarefaction     = rarefaction;
    fluid.viscosity       = 19.6e-6;
    fluid.thermal_speed   = std::sqrt(2. * 8.314462618 * 293.15 / 4.0026e-3);
    fluid.inlet_pressure  = 2e5;
    fluid.outlet_pressure = outlet_pressure;
    return fluid;
  }

  /** Helium as above, slipping with the coefficient σ = 1. */
  inline FluidParameters
  slipping_helium(const double outlet_pressure = 0.)
  {
    FluidParameters fluid = helium(Rarefaction::slip, outlet_pressure);
    fluid.accommodation   = 2. * 1.1466 / 2.1466;
    return fluid;
  }
} // namespace strait
