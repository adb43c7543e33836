// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_theory_compression_integral_h
#define strait_theory_compression_integral_h

#include <vector>

namespace strait
{
  /**
   * W(s) = ∫_s^∞ [γ + 3(1−γ) erf²(t)] exp(−t²) dt/t, the integral over the pressure in
   * Persson's mean gap, where s is the pressure in units of the stress that flattens
   * the waves in question (Almqvist et al., J. Mech. Phys. Solids 59 (2011) 2355).
   * Tabulated once, for it is needed a million times.
   */
  class CompressionIntegral
  {
  public:
    explicit CompressionIntegral(double gamma);

    /** For s > 0, to a relative 1e-9 where it matters and zero above largest(). */
    double operator()(double s) const;

    /** Beyond it W is less than 1e-20. */
    static double largest();

  private:
    /** −dW/d ln s. */
    double slope(double s) const;

    double              gamma;
    std::vector<double> table; // at equal steps of ln s
  };
} // namespace strait

#endif
