// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait::reference
{
  /**
   * Effective conductivities of media that are not uniform. The functions cubed_gap_*
   * return the cube of the effective gap, 12 η K_eff [length³].
   */

  /** g = g0 (1 + ε cos kx), flow along x: ⟨g⁻³⟩⁻¹ = g0³ (1−ε²)^{5/2}/(1+ε²/2). */
  double cubed_gap_along_wave(double mean_gap, double epsilon);

  /** g = g0 (1 + ε cos kx), flow along y: ⟨g³⟩ = g0³ (1 + 3ε²/2). */
  double cubed_gap_across_wave(double mean_gap, double epsilon);

  /**
   * g = g0 (1 + ε cos kx)(1 + δ cos ly), flow along x. As g is a product
   * A(x) B(y), the pressure depends on x alone.
   */
  double
  cubed_gap_of_product(double mean_gap, double epsilon_along, double epsilon_across);

  /** Checkerboard of two conductivities: √(K1 K2) (Keller 1964). */
  double checkerboard_conductivity(double first, double second);

  /**
   * Impermeable discs of the area fraction f on a square array in a medium of
   * conductivity 1 (Perrins, McKenzie, McPhedran 1979, their expansion to f⁸):
   * good to 1e-6 for f ≤ 0.5.
   */
  double conductivity_around_discs(double area_fraction);

  /**
   * The parabolic constriction g = g0 (1 + x²/l²)(1 − y²/w²), |y| < w, |x| ≤ X:
   * an isolated saddle that is about to close. The pressure depends on x alone.
   */
  struct ParabolicConstriction
  {
    double gap;       // g0
    double length;    // l
    double width;     // w
    double viscosity; // η

    /**
     * Pressure difference over flow rate between −X and X = @p half_length;
     * infinity is allowed.
     */
    double resistance(double half_length) const;
  };
} // namespace strait::reference
