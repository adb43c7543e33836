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
  /** A tabulated function of the gap that multiplies the viscous conductivity. */
  class GapFactor
  {
  public:
    GapFactor() = default;
    /** Tabulate @p function of the gap from 2⁻¹⁴ to 2¹⁴ times @p reference. Beyond the
     *  table the factor is constant above and inversely proportional to the gap below. */
    GapFactor(double reference, const std::function<double(double)> &function);

    /** The factor at @p gap > 0, linear between entries, with an error below 2·10⁻⁵. */
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
    static constexpr int octaves            = 14; // on either side of the reference
    static constexpr int entries_per_octave = 64;

    double              first = 0.; // log2 of the smallest gap of the table
    std::vector<double> values;
  };

  /** A part of a flow path: its gap and its ∫ ds/gap³. */
  struct PathPart
  {
    double gap;
    double resistance;
  };

  /**
   * Flow of a rarefied gas between two reservoirs, through gaps that resist like those
   * along a given path.
   *
   * Its equation ∇·(a ∇p) = 0 is nonlinear. With the mobility m = a/K of RarefiedGas, a
   * reference gap ḡ and the potential Ψ(p) = ∫ m(ḡ, p) dp it becomes ∇·(K w ∇Ψ) = 0, with
   * the weight w = m(g, p)/m(ḡ, p). The weight is one in viscous flow and where the gap
   * is ḡ; in molecular flow with slip it is ḡ/g at any pressure. The throughput is the
   * conductance of K w times ΔΨ.
   *
   * doc/gas_and_metals.md derives the bounds of the nonlinear problem, for which Ψ' is
   * chosen otherwise.
   */
  class RarefiedFlow
  {
  public:
    /** @p parts are sorted by gap. */
    RarefiedFlow(const FluidParameters &fluid, const std::vector<PathPart> &parts);

    /** ΔΨ over the mean pressure of the reservoirs [pressure], negative if the pressure
     *  rises towards the outlet. Times a conductance of K w it is the volume at that mean
     *  pressure that leaks per time. */
    double
    drive() const
    {
      return (pressure_falls ? total_drive : -total_drive) / mean_pressure;
    }

    /** The pressure at a @p potential, which is Ψ scaled to 1 at the inlet, 0 at the
     *  outlet. */
    double pressure(double potential) const;

    /** The weight w at @p gap and pressure @p p, divided by middle_weight. */
    double
    relative_weight(const double gap, const double p) const
    {
      return weight(gap, p) / middle_weight(gap);
    }

    /** The weight w of a gap at the pressure half way between the reservoirs in Ψ. */
    GapFactor middle_weight;

    /** Minimum and maximum of m/Ψ' of a gap over all pressures. Each has its own Ψ', but
     *  the same ΔΨ. */
    GapFactor least_weight, largest_weight;

    /** With slip: the mobility of a gap at p = 0 over that of the reference gap. */
    std::optional<GapFactor> molecular_weight;

    /** The lower bound of the leak rate, as a volume at the mean pressure of the
     *  reservoirs, that follows from a viscous and a molecular gas in the same gap;
     *  @p viscous and @p molecular are the conductances of K and of K times
     *  molecular_weight. */
    double two_gas_lower_bound(double viscous, double molecular) const;

    /** The gas itself. */
    const RarefiedGas gas;

  private:
    void      tabulate_potential();
    GapFactor extreme_weight(const std::vector<PathPart> &parts, bool is_largest) const;
    double    weight(double gap, double p) const;

    double              low, high; // pressures of the reservoirs
    double              reference_gap;
    double              mean_pressure;      // of the reservoirs
    double              total_drive;        // ΔΨ [pressure²]
    bool                pressure_falls;     // the pressure, towards the outlet
    std::vector<double> pressures;          // nodes from low to high
    std::vector<double> potentials, slopes; // Ψ, from 0 to 1, and dp/dΨ at the nodes
  };

  /** The flow of @p fluid in a gap whose path of least resistance is @p path; null if the
   *  fluid is not rarefied. */
  std::shared_ptr<const RarefiedFlow> make_rarefied_flow(const FluidParameters &fluid,
                                                         const FlowPath        &path);
} // namespace strait
