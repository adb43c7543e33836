// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/rarefied_flow.h>

#include <algorithm>
#include <numeric>

namespace strait
{
  namespace
  {
    // Pressures are tabulated closer and closer to the lower one, where a mobility may
    // vary with the logarithm of the pressure.
    constexpr int n_pressures = 256;

    // Of those, extremes are taken over one in so many; with half of it they are further
    // apart by less than the margin, which stands for the error of tables.
    constexpr int    stride = 4;
    constexpr double margin = 2e-6;
  } // namespace

  GapFactor::GapFactor(const double                         reference,
                       const std::function<double(double)> &function)
    : first(std::log2(reference) - octaves)
  {
    for (int k = 0; k <= 2 * octaves * entries_per_octave; ++k)
      values.push_back(
        function(std::exp2(first + k / static_cast<double>(entries_per_octave))));
  }

  RarefiedFlow::RarefiedFlow(const FluidParameters &fluid, const double reference_gap_)
    : gas(fluid)
    , reference_gap(reference_gap_)
    , falls(fluid.inlet_pressure > fluid.outlet_pressure)
  {
    const double low  = std::min(fluid.inlet_pressure, fluid.outlet_pressure);
    const double high = std::max(fluid.inlet_pressure, fluid.outlet_pressure);
    total_drive       = gas.drive(reference_gap, low, high);
    pressure_drive    = (falls ? total_drive : -total_drive) / fluid.mean_pressure();
    for (int i = 0; i <= n_pressures; ++i)
      {
        const double t = static_cast<double>(i) / n_pressures;
        pressures.push_back(low + (high - low) * t * t * t);
        potentials.push_back(gas.drive(reference_gap, low, pressures.back()) /
                             total_drive);
        slopes.push_back(total_drive / gas.mobility(reference_gap, pressures.back()));
      }
    const double middle = pressure(.5);
    middle_weight =
      GapFactor(reference_gap, [&](const double gap) { return weight(gap, middle); });
    least_weight   = GapFactor(reference_gap, [&](const double gap) {
      return (1. - margin) * extreme_weight(gap, false);
    });
    largest_weight = GapFactor(reference_gap, [&](const double gap) {
      return (1. + margin) * extreme_weight(gap, true);
    });
  }

  double
  RarefiedFlow::weight(const double gap, const double p) const
  {
    return gas.mobility(gap, p) / gas.mobility(reference_gap, p);
  }

  double
  RarefiedFlow::extreme_weight(const double gap, const bool is_largest) const
  {
    double extreme = 0.;
    for (int i = 0; i <= n_pressures; i += stride)
      {
        const double here = gas.mobility(gap, pressures[i]) * slopes[i];
        if (i == 0 || (is_largest ? here > extreme : here < extreme))
          extreme = here;
      }
    return extreme / total_drive;
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
    std::vector<std::size_t> segments(path.gaps.size() - 1);
    std::iota(segments.begin(), segments.end(), std::size_t(0));
    const auto gap_in = [&path](const std::size_t k) {
      return std::sqrt(path.gaps[k] * path.gaps[k + 1]);
    };
    std::sort(segments.begin(), segments.end(), [&](const auto a, const auto b) {
      return gap_in(a) < gap_in(b);
    });
    double      below = 0.;
    std::size_t k     = 0;
    while (true)
      {
        below += path.resistances[segments[k] + 1] - path.resistances[segments[k]];
        if (2. * below >= path.resistance() || k + 1 == segments.size())
          return std::make_shared<const RarefiedFlow>(fluid, gap_in(segments[k]));
        ++k;
      }
  }
} // namespace strait
