// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>

namespace strait
{
  /**
   * What an ideal gas at one temperature carries between parallel walls, from viscous to
   * molecular flow. Its throughput per width is −a ∇p [pressure length²/time], of which
   * doc/gas_and_metals.md has the formulas; viscous flow has a = p g³/(12 η).
   */
  class RarefiedGas
  {
  public:
    /** @p fluid must know its thermal speed, unless the gas is viscous. */
    explicit RarefiedGas(const FluidParameters &fluid);

    /**
     * Q_P at @p delta > 0 [1] of a transitional gas: of the linearised BGK equation
     * between walls that reflect diffusely, interpolated to 10⁻⁵ of a solution of its
     * integral equation (tools/bgk_poiseuille.py), and its asymptotes beyond.
     */
    static double poiseuille_coefficient(double delta);

    /**
     * a over the viscous conductivity g³/(12 η) [pressure]: p of a viscous gas, p + r/g
     * with slip. Where a transitional gas is so thin that molecules fly a million times
     * the gap it is taken to be no thinner; without an end it would grow with the
     * logarithm of that. Half and double of it change a leak against vacuum by less than
     * 10⁻⁶ of itself.
     */
    double mobility(double gap, double p) const;

    /** The mean of the mobility at pressures from @p low to @p high [pressure]. */
    double mean_mobility(double gap, double low, double high) const;

    /** ∫ mobility dp from @p low to @p high [pressure²]: the throughput between plates,
     *  per length and viscous conductivity. */
    double
    drive(const double gap, const double low, const double high) const
    {
      return (high - low) * mean_mobility(gap, low, high);
    }

    /** Mean free path over @p gap at @p p, λ = (√π/2) η v0/p [1]. */
    double knudsen_number(double gap, double p) const;

  private:
    Rarefaction kind;
    double      scale; // η v0 [pressure length]
    double      slip;  // σ √π/2
  };
} // namespace strait
