// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_leakage_table_h
#define strait_run_leakage_table_h

#include <strait/base/scene.h>
#include <strait/base/table.h>
#include <strait/base/units.h>
#include <strait/run/step.h>

namespace strait
{
  /** The table leakage.csv, with the columns of the effects that @p scene enables. */
  Table<Step> leakage_table(const Scene &scene);

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
