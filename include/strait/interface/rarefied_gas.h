// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>

namespace strait
{
  /** Flow of an ideal gas at uniform temperature between parallel walls, from viscous to
   *  molecular. Its throughput per width is −a ∇p [pressure length²/time]; in viscous
   *  flow a = p g³/(12 η), and doc/gas_and_metals.md has the other formulas. */
  class RarefiedGas
  {
  public:
    /** @p fluid must have a thermal speed, unless the gas is viscous. */
    explicit RarefiedGas(const FluidParameters &fluid);

    /** The coefficient Q_P [1] of a transitional gas at @p delta = p g/(η v0) > 0, from
     *  the linearised BGK equation between walls that reflect diffusely: interpolated to
     *  10⁻⁵ in a table of solutions of its integral equation (tools/bgk_poiseuille.py),
     *  and asymptotic beyond. */
    static double poiseuille_coefficient(double delta);

    /** The coefficient a over the viscous conductivity g³/(12 η) [pressure]: p for a
     *  viscous gas, p + r/g with slip. The mobility of a transitional gas grows without
     *  limit, like −ln p, as p falls to zero; it is therefore cut off where δ is the
     *  smallest normalised double. */
    double mobility(double gap, double p) const;

    /** The mean of the mobility at pressures from @p low to @p high [pressure]. */
    double mean_mobility(double gap, double low, double high) const;

    /** ∫ mobility dp from @p low to @p high [pressure²]. Times the viscous conductivity
     *  and over the length it is the throughput per width between plates. */
    double
    drive(const double gap, const double low, const double high) const
    {
      return (high - low) * mean_mobility(gap, low, high);
    }

    /** The Knudsen number [1]: the mean free path λ = (√π/2) η v0/p at pressure @p p over
     *  @p gap. */
    double knudsen_number(double gap, double p) const;

  private:
    Rarefaction kind;
    double      scale; // η v0 [pressure length]
    double      slip;  // σ √π/2
  };
} // namespace strait
