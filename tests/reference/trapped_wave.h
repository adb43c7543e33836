// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait::reference
{
  /**
   * Westergaard's contact with fluid in its valleys, trapped at zero pressure under the
   * load P0. Loads and pressures are in units of p* (see Westergaard). The fluid pressure
   * p_t only moves the wall as a whole. Under the load p the contact is therefore that
   * under P = p − p_t without fluid, and the fluid fills its mean gap, 1 − P + P ln P in
   * units of the amplitude.
   */
  struct TrappedWave
  {
    double load_when_trapped;       // P0
    double bulk_modulus       = 0.; // at zero pressure; 0: the fluid is incompressible
    double bulk_modulus_slope = 0.; // its derivative with respect to pressure

    /** The pressure p_t of the trapped fluid under @p load >= P0. */
    double fluid_pressure(double load) const;
  };
} // namespace strait::reference
