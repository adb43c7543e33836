// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait::reference
{
  /**
   * Westergaard's contact of an elastic half-space with the wave
   * h = Δ cos(2πx/λ), crest at x = 0, under the nominal pressure p0
   * (Westergaard 1939; Johnson, Contact Mechanics, 1985). Beyond full_pressure()
   * contact is complete.
   */
  struct Westergaard
  {
    double amplitude; // Δ
    double wavelength;
    double modulus; // contact modulus E*
    double nominal_pressure;

    /** p* = πE*Δ/λ, at which contact becomes complete. */
    double full_pressure() const;

    /** The half-width a of the contact: sin²(πa/λ) = p0/p*. */
    double contact_half_width() const;

    /** The pressure p(x), 0 out of contact. */
    double pressure(double x) const;

    /** The gap g(x), 0 in contact. */
    double gap(double x) const;

    /** The mean gap, Δ (1 − P + P ln P) with P = p0/p*. */
    double mean_gap() const;
  };

  /**
   * Contact with the wave h = Δ cos(2πx/λ) cos(2πy/λ) in the limits of low and
   * high load (Johnson, Greenwood, Higginson 1985). @p load is p0/p*.
   */
  namespace product_wave
  {
    /** p* = √2 πE*Δ/λ, at which contact becomes complete. */
    double full_pressure(double amplitude, double wavelength, double modulus);

    /** Contact area over nominal area as load → 0: π (3 load/(8π))^{2/3}. */
    double contact_fraction_at_low_load(double load);

    /** Contact area over nominal area as load → 1: 1 − 3 (1 − load)/(2π). */
    double contact_fraction_at_high_load(double load);
  } // namespace product_wave

  /** The square saddle h = Δ [2 + cos(2πx/λ) + cos(2πy/λ)]. */
  namespace square_saddle
  {
    /** p* = 2πE*Δ/λ, at which contact becomes complete. */
    double full_pressure(double amplitude, double wavelength, double modulus);

    /** Rc with 1/Rc² = ½ Σ (qx⁴ + qy⁴) |h~|²: λ²/(2√2 π² Δ). */
    double curvature_radius(double amplitude, double wavelength);
  } // namespace square_saddle
} // namespace strait::reference
