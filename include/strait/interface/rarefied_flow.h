// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/interface/rarefied_gas.h>
#include <strait/percolation/flow_path.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace strait
{
  /** What the viscous conductivity of a gap is multiplied by, tabulated. */
  class GapFactor
  {
  public:
    GapFactor() = default;
    /** Of a @p function of the gap; 2¹⁴ times above and below @p reference the table
     * ends, with a factor that is constant above and in inverse proportion to the gap
     * below.
     */
    GapFactor(double reference, const std::function<double(double)> &function);

    /** At @p gap > 0. Between entries linear, which is wrong by less than 2·10⁻⁵. */
    double
    operator()(const double gap) const
    {
      const double place = (std::log2(gap) - first) * entries_per_octave;
      if (!(place > 0.))
        return values.front() * std::exp2(-place / entries_per_octave);
      const auto k = static_cast<std::size_t>(place);
      if (k + 1 >= values.size())
        return values.back();
      return values[k] + (place - static_cast<double>(k)) * (values[k + 1] - values[k]);
    }

  private:
    static constexpr int octaves            = 14; // on either side
    static constexpr int entries_per_octave = 64;

    double              first = 0.; // log2 of the smallest gap
    std::vector<double> values;
  };

  /** A part of a path: its gap and its ∫ ds/gap³. */
  struct PathPart
  {
    double gap;
    double resistance;
  };

  /**
   * A rarefied gas between two reservoirs, in gaps that resist like those of a path.
   *
   * Its equation ∇·(a ∇p) = 0 is not linear, but with Ψ(p) = ∫ m(ḡ, p) dp and the
   * mobility m = a/K of RarefiedGas it is ∇·(K w ∇Ψ) = 0 with a weight w = m(g, p)/m(ḡ,
   * p) that differs from one only where the gap differs from the reference ḡ and the flow
   * is neither viscous nor molecular. The throughput is the conductance of K w times ΔΨ.
   *
   * doc/gas_and_metals.md derives the bounds of the nonlinear problem, for which Ψ' is
   * chosen otherwise.
   */
  class RarefiedFlow
  {
  public:
    /** @p parts are in the order of their gaps. */
    RarefiedFlow(const FluidParameters &fluid, const std::vector<PathPart> &parts);

    /** ΔΨ over the mean pressure of the reservoirs: times a conductance of K w it is the
     *  volume, at that pressure, that leaks per time [pressure]. */
    double
    drive() const
    {
      return (falls ? total_drive : -total_drive) / mean_pressure;
    }

    /** The pressure at a Ψ that is @p potential: 1 at the inlet, 0 at the outlet. */
    double pressure(double potential) const;

    /** w at @p gap and @p p, over middle_weight(). */
    double
    relative_weight(const double gap, const double p) const
    {
      return weight(gap, p) / middle_weight(gap);
    }

    /** w of a gap at the pressure half way between the reservoirs in Ψ. */
    GapFactor middle_weight;

    /** min and max m/Ψ' of a gap at any pressure, each with its own Ψ', of the same ΔΨ.
     */
    GapFactor least_weight, largest_weight;

    /** With slip, r of a gap over that of the reference gap. */
    std::optional<GapFactor> molecular_weight;

    /** The least that leaks of two gases side by side, as a volume at the mean pressure
     *  of the reservoirs, if @p viscous and @p molecular are the conductances of K and of
     *  K molecular_weight. */
    double least_of_two(double viscous, double molecular) const;

    /** The gas itself. */
    const RarefiedGas gas;

  private:
    void      tabulate_potential();
    GapFactor extreme_weight(const std::vector<PathPart> &parts, bool is_largest) const;
    double    weight(double gap, double p) const;

    double              low, high; // pressures
    double              reference_gap;
    double              mean_pressure;      // of the reservoirs
    double              total_drive;        // ΔΨ [pressure²]
    bool                falls;              // the pressure, from the inlet to the outlet
    std::vector<double> pressures;          // from the lower one up
    std::vector<double> potentials, slopes; // Ψ at the pressures, 0 to 1, and dp/dΨ
  };

  /** That of @p fluid in a gap with this @p path, null for one that is not rarefied. */
  std::shared_ptr<const RarefiedFlow> make_rarefied_flow(const FluidParameters &fluid,
                                                         const FlowPath        &path);
} // namespace strait
