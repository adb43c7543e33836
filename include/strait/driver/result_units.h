// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_result_units_h
#define strait_driver_result_units_h

#include <strait/base/fluid_parameters.h>
#include <strait/base/units.h>

#include <string>

namespace strait
{
  /**
   * The unit of a column of leakage.csv, in the scene's units: "m³/s", "1" for plain
   * numbers, empty for text.
   */
  std::string unit_of_column(const std::string &column, const UnitParameters &units);

  /**
   * What a leak rate in the scene's units is in @p unit. A throughput is that rate
   * times the mean of the two pressures: exact for an ideal gas at one temperature
   * in viscous flow, because ∫ K p dp = K (p_in² − p_out²)/2.
   */
  double in_trade_unit(double                 leak_rate,
                       const LeakRateUnit    &unit,
                       const UnitParameters  &units,
                       const FluidParameters &fluid);
} // namespace strait

#endif
