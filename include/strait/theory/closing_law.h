// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_theory_closing_law_h
#define strait_theory_closing_law_h

#include <vector>

namespace strait
{
  /**
   * How the last constriction of an elastic contact closes, from slender-contact
   * asymptotics: the contact at the critical load is a needle on the ridge between two
   * patches that merge, which thins without limit towards their meeting point. Local
   * exponents against the reduced load ε = 1 − L/L_c then drift with
   *
   *   Λ = 1 + √(½ ln(1/ε) + C)
   *
   * towards those of Λ → ∞: 1 for the gap, ½ for width and length, 3 for the leak rate.
   * Formal asymptotics; no proof.
   */
  struct ClosingLaw
  {
    /** C, the one constant that depends on the surface. Fitted to a square saddle between
     *  ε = 1e-2 and 1e-4. */
    double constant = -.1;

    /** A local exponent that was measured around one reduced load. */
    struct Slope
    {
      double reduced_load;
      double exponent;
    };

    /** The law whose exponents of the leak rate agree with @p leak_rate in the mean. Not
     *  a number for the constant if there is none. */
    static ClosingLaw fit(const std::vector<Slope> &leak_rate);

    /** s in gap ∝ ε^s, of the constriction's narrowest point: 1 + 1/(2Λ). */
    double gap_exponent(double reduced_load) const;

    /** Of the half-width of the channel there: 1/(2 + 1/Λ²). */
    double width_exponent(double reduced_load) const;

    /** Of the length along the channel within which the gap doubles: half the gap's. */
    double length_exponent(double reduced_load) const;

    /** Of the leak rate, ∝ gap^{5/2} · width. */
    double leak_rate_exponent(double reduced_load) const;

    /** Λ. */
    double lambda(double reduced_load) const;
  };
} // namespace strait

#endif
