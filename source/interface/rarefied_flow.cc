// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/rarefied_flow.h>

#include <algorithm>
#include <numeric>

namespace strait
{
  namespace
  {
    // What stands for the error of tables, in the gap and in the pressure, in bounds.
    constexpr double margin = 1e-5;

    /** The pressures at the ends of @p parts in a row, from @p low to @p high; their flow
     *  need not be exact. */
    std::vector<double>
    pressures_in_row(const RarefiedGas           &gas,
                     const std::vector<PathPart> &parts,
                     const double                 low,
                     const double                 high)
    {
      std::vector<double> pressures(parts.size() + 1, low);
      // dp/dR = J/m by the midpoint rule in a few steps.
      const auto flow = [&](const double throughput) {
        constexpr int steps = 16;
        double        p     = low;
        for (std::size_t k = 0; k < parts.size(); ++k)
          {
            const double rise = throughput * parts[k].resistance / steps;
            for (int step = 0; step < steps && p < high; ++step)
              {
                const double half = .5 * rise / gas.mobility(parts[k].gap, p);
                p += rise / gas.mobility(parts[k].gap, p + half);
              }
            pressures[k + 1] = std::min(p, high);
          }
        return p;
      };
      double most = 1.; // an upper bound of the throughput, then bisection
      while (flow(most) < high)
        most *= 2.;
      double least = 0.;
      for (int round = 0; round < 60; ++round)
        {
          const double middle                  = .5 * (least + most);
          (flow(middle) < high ? least : most) = middle;
        }
      pressures.back() = high;
      return pressures;
    }

    /** Ψ' of parts in a row. */
    class RowPotential
    {
    public:
      RowPotential(const RarefiedGas    &gas_,
                   std::vector<PathPart> parts_,
                   const double          low,
                   const double          high,
                   const double          total)
        : gas(gas_)
        , parts(std::move(parts_))
        , pressures(pressures_in_row(gas, parts, low, high))
        , amplitudes(parts.size(), 1.)
      {
        double sum = 0.;
        for (std::size_t k = 0; k < parts.size(); ++k)
          {
            if (k > 0)
              amplitudes[k] = amplitudes[k - 1] *
                              gas.mobility(parts[k - 1].gap, pressures[k]) /
                              gas.mobility(parts[k].gap, pressures[k]);
            sum +=
              amplitudes[k] * gas.drive(parts[k].gap, pressures[k], pressures[k + 1]);
          }
        for (double &amplitude : amplitudes)
          amplitude *= total / sum;
        list_samples(low, high);
      }

      /** The extreme of m/Ψ' at any pressure. */
      double
      extreme(const double gap, const bool is_largest) const
      {
        double result = 0.;
        for (std::size_t i = 0; i < samples.size(); ++i)
          {
            const double here = gas.mobility(gap, samples[i]) / values[i];
            if (i == 0 || (is_largest ? here > result : here < result))
              result = here;
          }
        return result;
      }

    private:
      /** In a part m/Ψ' has its extremes at the ends, but for a gas so thin that Q_P
       * varies with the logarithm of the pressure alone. */
      void
      list_samples(const double low, const double high)
      {
        constexpr double step = 1.1, decades = 8.;
        samples = pressures;
        for (double p = high; p > std::max(low, std::pow(10., -decades) * high);
             p /= step)
          samples.push_back(p);
        std::sort(samples.begin(), samples.end());
        std::size_t k = 0;
        for (const double p : samples)
          {
            while (k + 1 < parts.size() && p > pressures[k + 1])
              ++k;
            values.push_back(amplitudes[k] * gas.mobility(parts[k].gap, p));
          }
      }

      const RarefiedGas    &gas;
      std::vector<PathPart> parts;
      std::vector<double>   pressures; // at the ends of the parts
      std::vector<double>   amplitudes;
      std::vector<double>   samples, values; // pressures, and Ψ' at them
    };

    double
    median_gap(const std::vector<PathPart> &parts)
    {
      double total = 0., below = 0.;
      for (const PathPart &part : parts)
        total += part.resistance;
      for (const PathPart &part : parts)
        if ((below += part.resistance) >= .5 * total)
          return part.gap;
      return parts.back().gap;
    }
  } // namespace

  GapFactor::GapFactor(const double                         reference,
                       const std::function<double(double)> &function)
    : first(std::log2(reference) - octaves)
  {
    for (int k = 0; k <= 2 * octaves * entries_per_octave; ++k)
      values.push_back(
        function(std::exp2(first + k / static_cast<double>(entries_per_octave))));
  }

  RarefiedFlow::RarefiedFlow(const FluidParameters       &fluid,
                             const std::vector<PathPart> &parts)
    : gas(fluid)
    , low(std::min(fluid.inlet_pressure, fluid.outlet_pressure))
    , high(std::max(fluid.inlet_pressure, fluid.outlet_pressure))
    , reference_gap(median_gap(parts))
    , total_drive(gas.drive(reference_gap, low, high))
    , falls(fluid.inlet_pressure > fluid.outlet_pressure)
  {
    pressure_drive = (falls ? total_drive : -total_drive) / fluid.mean_pressure();
    tabulate_potential();
    const double middle = pressure(.5);
    middle_weight =
      GapFactor(reference_gap, [&](const double gap) { return weight(gap, middle); });
    const RowPotential narrow_first(gas, parts, low, high, total_drive);
    const RowPotential wide_first(
      gas, {parts.rbegin(), parts.rend()}, low, high, total_drive);
    least_weight   = GapFactor(reference_gap, [&](const double gap) {
      return (1. - margin) * wide_first.extreme(gap, false);
    });
    largest_weight = GapFactor(reference_gap, [&](const double gap) {
      return (1. + margin) * narrow_first.extreme(gap, true);
    });
  }

  void
  RarefiedFlow::tabulate_potential()
  {
    // Closer and closer to the lower pressure, where a mobility may vary with the
    // logarithm of the pressure. With half as many a pressure is wrong by 10⁻⁸.
    constexpr int n = 256;
    for (int i = 0; i <= n; ++i)
      {
        const double t = static_cast<double>(i) / n;
        const double p = low + (high - low) * t * t * t;
        potentials.push_back(i == 0 ? 0.
                                    : potentials.back() +
                                        gas.drive(reference_gap, pressures.back(), p) /
                                          total_drive);
        pressures.push_back(p);
        slopes.push_back(total_drive / gas.mobility(reference_gap, p));
      }
  }

  double
  RarefiedFlow::weight(const double gap, const double p) const
  {
    return gas.mobility(gap, p) / gas.mobility(reference_gap, p);
  }

  double
  RarefiedFlow::pressure(const double potential) const
  {
    const double value = falls ? potential : 1. - potential;
    const auto   above =
      std::clamp(std::upper_bound(potentials.begin(), potentials.end(), value),
                 potentials.begin() + 1,
                 potentials.end() - 1);
    // The cubic with the slopes at both ends.
    const auto   i     = static_cast<std::size_t>(above - potentials.begin());
    const double width = potentials[i] - potentials[i - 1];
    const double t     = std::clamp((value - potentials[i - 1]) / width, 0., 1.);
    return pressures[i - 1] * (1. + 2. * t) * (1. - t) * (1. - t) +
           pressures[i] * (3. - 2. * t) * t * t +
           width * t * (1. - t) * (slopes[i - 1] * (1. - t) - slopes[i] * t);
  }

  std::shared_ptr<const RarefiedFlow>
  make_rarefied_flow(const FluidParameters &fluid, const FlowPath &path)
  {
    if (fluid.rarefaction == Rarefaction::none)
      return {};
    std::vector<PathPart> steps;
    for (std::size_t k = 0; k + 1 < path.gaps.size(); ++k)
      steps.push_back({std::sqrt(path.gaps[k] * path.gaps[k + 1]),
                       path.resistances[k + 1] - path.resistances[k]});
    std::sort(steps.begin(), steps.end(), [](const auto &a, const auto &b) {
      return a.gap < b.gap;
    });
    // Of the path's resistance at most, unless a single step has more. With half as many
    // parts the bounds are further apart by a thousandth of the leak rate, twice as many
    // take twice the time.
    constexpr double      fraction = 1. / 64;
    std::vector<PathPart> parts;
    for (const PathPart &step : steps)
      if (parts.empty() ||
          parts.back().resistance + step.resistance > fraction * path.resistance())
        parts.push_back(step);
      else
        {
          PathPart    &part  = parts.back();
          const double total = part.resistance + step.resistance;
          part.gap = (part.gap * part.resistance + step.gap * step.resistance) / total;
          part.resistance = total;
        }
    return std::make_shared<const RarefiedFlow>(fluid, parts);
  }
} // namespace strait
