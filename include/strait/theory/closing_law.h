// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_theory_closing_law_h
#define strait_theory_closing_law_h

#include <vector>

namespace strait
{
  /** How the last constriction of an elastic contact closes, from slender-contact
   *  asymptotics (doc/theory.md): local exponents against the reduced load ε = 1 − L/L_c
   *  drift with Λ = 1 + √(½ ln(1/ε) + C). Formal; no proof. */
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

    /** Local exponents, each of a quantity ∝ ε^s. */
    struct Exponents
    {
      double gap;       // of the constriction's narrowest point
      double width;     // half that of the channel there
      double length;    // along the channel within which the gap doubles
      double leak_rate; // ∝ gap^{5/2} · width
    };

    /** Those around one reduced load. */
    Exponents at(double reduced_load) const;
  };
} // namespace strait

#endif
