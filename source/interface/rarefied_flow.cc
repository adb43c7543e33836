// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/rarefied_flow.h>

#include <algorithm>
#include <limits>

namespace strait
{
  namespace
  {
    // Relative allowance, in the bounds, for the errors of the tables in the gap and in
    // the pressure.
    constexpr double margin = 3e-5;

    std::vector<double>
    logarithms(std::vector<double> values)
    {
      for (double &value : values)
        value = std::log(value);
      return values;
    }

    /**
     * Find the potential Ψ that makes one of the bounds closest: the upper one if
     * @p is_largest. It follows from the dual problem, which is to place the parts of the
     * path at such pressures that the most flows, or the least for the lower bound. Ψ' is
     * that of the reference gap times a factor that is linear in the reference's Ψ
     * between nodes. The nodes lie where this Ψ, from 0 to 1, is @p potentials, and
     * @p weights[part][node] are the weights of the @p parts there.
     * @return the factors at the nodes.
     */
    std::vector<double>
    best_factors(const std::vector<PathPart>            &parts,
                 const std::vector<std::vector<double>> &weights,
                 const std::vector<double>              &potentials,
                 const bool                              is_largest)
    {
      const double        sign = is_largest ? 1. : -1.;
      const std::size_t   n    = potentials.size();
      std::vector<double> lengths(n, 0.); // ΔΨ around the nodes
      for (std::size_t i = 1; i < n; ++i)
        for (const std::size_t end : {i - 1, i})
          lengths[end] += .5 * (potentials[i] - potentials[i - 1]);
      std::vector<std::vector<double>> log_weights;
      log_weights.reserve(weights.size());
      for (const std::vector<double> &of_part : weights)
        log_weights.push_back(logarithms(of_part));
      std::vector<double> trial(n, 1.), best;
      double              best_bound = sign * std::numeric_limits<double>::infinity();

      // Bound what flows through the parts in series by the extremes of weight over
      // factor.
      const auto keep_if_better = [&]() {
        double drive = 0., resistance = 0.;
        for (std::size_t i = 0; i < n; ++i)
          drive += trial[i] * lengths[i];
        for (std::size_t k = 0; k < parts.size(); ++k)
          {
            double extreme = weights[k][0] / trial[0];
            for (std::size_t i = 1; i < n; ++i)
              if (const double here = weights[k][i] / trial[i];
                  sign * (here - extreme) > 0.)
                extreme = here;
            resistance += parts[k].resistance / extreme;
          }
        const double bound = drive / resistance;
        if (sign * (best_bound - bound) < 0.)
          return;
        best_bound = bound;
        best       = trial;
        for (double &factor : best)
          factor /= drive;
      };

      // Spread each part over the nodes where its weight over the factor is extreme, like
      // a Boltzmann distribution at this temperature. Then raise (for the lower bound:
      // lower) the factor where more resistance has gathered than on average.
      const auto relax = [&](const double temperature) {
        std::vector<double>       loads(n, 0.), places(n);
        const std::vector<double> log_trial = logarithms(trial);
        double                    total     = 0.;
        for (std::size_t k = 0; k < parts.size(); ++k)
          {
            for (std::size_t i = 0; i < n; ++i)
              places[i] = sign / temperature * (log_weights[k][i] - log_trial[i]);
            const double highest = *std::max_element(places.begin(), places.end());
            double       sum     = 0.;
            for (std::size_t i = 0; i < n; ++i)
              sum += places[i] = lengths[i] * std::exp(places[i] - highest);
            for (std::size_t i = 0; i < n; ++i)
              {
                const double load = parts[k].resistance * places[i] / sum / weights[k][i];
                loads[i] += load;
                total += load;
              }
          }
        // On nodes without load any small value will do.
        for (std::size_t i = 0; i < n; ++i)
          trial[i] *= std::pow(std::max(loads[i] / (total * lengths[i]), temperature),
                               sign * temperature);
      };

      keep_if_better();
      // With half as many rounds the bounds are further apart by 2·10⁻⁴ of the leak rate;
      // twice as many gain less than 10⁻⁴ in twice the time.
      constexpr int rounds = 20;
      for (const double temperature : {.03, .01, .003})
        for (int round = 0; round < rounds; ++round)
          {
            relax(temperature);
            keep_if_better();
          }
      return best;
    }

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
    , mean_pressure(fluid.mean_pressure())
    , total_drive(gas.drive(reference_gap, low, high))
    , pressure_falls(fluid.inlet_pressure > fluid.outlet_pressure)
  {
    tabulate_potential();
    const double middle = pressure(.5);
    middle_weight =
      GapFactor(reference_gap, [&](const double gap) { return weight(gap, middle); });
    least_weight   = extreme_weight(parts, false);
    largest_weight = extreme_weight(parts, true);
    if (fluid.rarefaction == Rarefaction::slip)
      molecular_weight = GapFactor(reference_gap, [&](const double gap) {
        return gas.mobility(gap, 0.) / gas.mobility(reference_gap, 0.);
      });
  }

  double
  RarefiedFlow::two_gas_lower_bound(const double viscous, const double molecular) const
  {
    const double mixed = 2. / 3. * (std::pow(high, 1.5) - std::pow(low, 1.5));
    const double a     = .5 * (high * high - low * low) * viscous;
    const double k     = gas.mobility(reference_gap, 0.) * molecular;
    const double b     = (high - low) * k;
    return (1. - margin) / mean_pressure *
           (.5 * (a + b) +
            std::sqrt(.25 * (a - b) * (a - b) + viscous * k * mixed * mixed));
  }

  GapFactor
  RarefiedFlow::extreme_weight(const std::vector<PathPart> &parts,
                               const bool                   is_largest) const
  {
    std::vector<std::vector<double>> weights;
    for (const PathPart &part : parts)
      {
        weights.emplace_back();
        for (const double p : pressures)
          weights.back().push_back(weight(part.gap, p));
      }
    const std::vector<double> factors =
      best_factors(parts, weights, potentials, is_largest);
    // The extremes lie close to the nodes, unless the mobility varies with the logarithm
    // of the pressure. Then samples are needed between them, down to a negligible
    // pressure. With steps twice as large the bounds are off by 2·10⁻⁵ of the leak rate.
    constexpr double    step = 1.15, lowest = std::numeric_limits<double>::epsilon();
    std::vector<double> samples{low};
    std::vector<double> values{gas.mobility(reference_gap, low) * factors[0]};
    for (std::size_t i = 1; i < pressures.size(); ++i)
      for (double p = pressures[i]; p > pressures[i - 1] && p > lowest * high; p /= step)
        {
          const double t = gas.drive(reference_gap, pressures[i - 1], p) /
                           (total_drive * (potentials[i] - potentials[i - 1]));
          samples.push_back(p);
          values.push_back(gas.mobility(reference_gap, p) *
                           ((1. - t) * factors[i - 1] + t * factors[i]));
        }
    return GapFactor(reference_gap, [&](const double gap) {
      double extreme = gas.mobility(gap, samples[0]) / values[0];
      for (std::size_t i = 1; i < samples.size(); ++i)
        {
          const double here = gas.mobility(gap, samples[i]) / values[i];
          extreme = is_largest ? std::max(extreme, here) : std::min(extreme, here);
        }
      return extreme * (is_largest ? 1. + margin : 1. - margin);
    });
  }

  void
  RarefiedFlow::tabulate_potential()
  {
    // The nodes crowd towards the lower pressure, where the mobility may vary with the
    // logarithm of the pressure. Half and double of n move the bounds by 2·10⁻⁴ of the
    // leak rate.
    constexpr int n = 128;
    // Take ratios of mean mobilities, as the differences of Ψ themselves may all vanish.
    const double mean_mobility = gas.mean_mobility(reference_gap, low, high);
    double       part = 0., p = low, potential = 0.;
    for (int i = 0; i <= n; ++i)
      {
        const double part_before = part, p_before = p;
        part = std::pow(static_cast<double>(i) / n, 3);
        p    = low + (high - low) * part;
        potential += (part - part_before) / mean_mobility *
                     gas.mean_mobility(reference_gap, p_before, p);
        potentials.push_back(potential);
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
    const double value = pressure_falls ? potential : 1. - potential;
    const auto   above =
      std::clamp(std::upper_bound(potentials.begin(), potentials.end(), value),
                 potentials.begin() + 1,
                 potentials.end() - 1);
    // The cubic Hermite polynomial between two nodes.
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
    // The largest share of the path's resistance in a part, unless a single step has
    // more. With parts twice as large the bounds are further apart by 2·10⁻⁴ of the leak
    // rate; parts half as large gain less than 10⁻⁴ in twice the time.
    constexpr double      fraction = 1. / 32;
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
