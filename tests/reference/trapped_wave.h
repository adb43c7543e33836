// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait::reference
{
  /**
   * Westergaard's contact with fluid in its valleys, which was trapped without pressure
   * under the load P0 (of all loads and pressures in units of p*, see Westergaard). The
   * fluid's pressure only moves the wall as a whole, so that under the load p the contact
   * is that under P = p − p_t alone, and its gap, 1 − P + P ln P in units of the
   * amplitude, is what the fluid fills.
   */
  struct TrappedWave
  {
    double load_when_trapped;       // P0
    double bulk_modulus       = 0.; // without pressure; 0: the fluid is incompressible
    double bulk_modulus_slope = 0.; // its derivative by the pressure

    /** p_t under @p load >= P0. */
    double fluid_pressure(double load) const;
  };
} // namespace strait::reference
