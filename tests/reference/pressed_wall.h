// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait
{
  /** Clausen's function Cl₂(θ) = Σ_{k>=1} sin(kθ)/k², to rounding. */
  double clausen(double theta);

  /**
   * A gap without contact through which a fluid flows along x, from the pressure p_in at
   * x = 0 to 0 at x = Lx; the box is periodic. To first order in p_in the pressure falls
   * linearly and, at a fixed mean gap g0, the wall opens by
   *   g − g0 = p_in Lx/(π² E*) · Cl₂(2πx/Lx).
   */
  struct PressedWall
  {
    double inlet_pressure;
    double contact_modulus;
    double length;
    double mean_gap;

    /** The small parameter ε = p_in Lx/(π² E* g0). */
    double parameter() const;

    /** g − g0 at @p x, to first order. */
    double gap_change(double x) const;

    /**
     * The leak rate over that of the undeformed gap, 1/⟨(g/g0)⁻³⟩, to second order in ε:
     * 1 − 6 ε² ⟨Cl₂²⟩ with ⟨Cl₂²⟩ = π⁴/180.
     */
    double leak_rate_ratio() const;
  };
} // namespace strait
