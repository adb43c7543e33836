// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/iteration.h>
#include <strait/flow/reynolds_solver.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace strait
{
  namespace
  {
    /** Return the weight of each owned cell, at the pressure of its mean potential and
     *  for the gap that has its mean conductivity; relative to
     *  RarefiedFlow::middle_weight, which the coefficient contains. */
    std::vector<double>
    weights_of_cells(const PotentialProblem &pressure, const GapField &gap)
    {
      const RarefiedFlow &gas = *gap.gas();
      std::vector<double> weights(pressure.cells().size(), 1.), values;
      for (std::size_t c = 0; c < weights.size(); ++c)
        if (pressure.is_active(c))
          {
            pressure.cell_values(c, values);
            const double mean = std::accumulate(values.begin(), values.end(), 0.) /
                                static_cast<double>(values.size());
            weights[c] = gas.relative_weight(gap.gap_of(pressure.unweighted_mean(c)),
                                             gas.pressure(mean));
          }
      return weights;
    }
  } // namespace

  LinearSolve
  ReynoldsSolver::solve_rarefied()
  {
    PotentialProblem &pressure = pressure_problem;
    LinearSolve       outcome;
    const bool        has_solution = pressure.solution().size() > 0;
    pressure.take_coefficient(gap_field);
    if (has_solution)
      pressure.set_weights(weights_of_cells(pressure, gap_field));
    // Each round changes the weights several times less than the one before, and what the
    // last one changes is more than the error that it leaves. Two or three are usual.
    for (int round = 1;; ++round)
      {
        const LinearSolve solve = pressure.solve(accuracy());
        outcome.iterations += solve.iterations;
        const double before = pressure.energy();
        pressure.set_weights(weights_of_cells(pressure, gap_field));
        const double change = std::abs(pressure.energy() / before - 1.);
        outcome.converged   = solve.converged && change <= intermediate_tolerance_factor *
                                                           parameters.target_accuracy;
        if (outcome.converged || !solve.converged || round == iteration_limit)
          return outcome;
      }
  }

  void
  ReynoldsSolver::bound_rarefied(const FlowPath &path, Leakage &leakage)
  {
    using Coefficient = GapField::Coefficient;
    std::optional<HierarchicalCorrection> correction;
    if (parameters.element_degree == 1)
      correction.emplace(flow_mesh);
    const auto least_energy = [&](const Coefficient coefficient) {
      PotentialProblem problem(flow_mesh, gap_field.moment_set(), coefficient);
      problem.take_coefficient(gap_field);
      leakage.iterations += problem.solve(accuracy()).iterations;
      return correction ? correction->relax(problem, gap_field) : problem.energy();
    };
    const RarefiedFlow &gas     = *gap_field.gas();
    const double        driving = std::abs(drive());
    leakage.mesh_width          = leakage.relative_width();
    leakage.knudsen =
      gas.gas.knudsen_number(path.bottleneck_gap,
                             gas.pressure(1. - path.part_before_throat()));
    leakage.upper = driving * least_energy(Coefficient::largest_conductivity);
    leakage.lower = driving / least_energy(Coefficient::largest_resistivity);
    leakage.bound = "any-order";
    if (gas.molecular_weight)
      {
        const double least =
          gas.two_gas_lower_bound(1. / least_energy(Coefficient::viscous_resistivity),
                                  1. / least_energy(Coefficient::molecular_resistivity));
        if (least > leakage.lower)
          {
            leakage.lower = least;
            leakage.bound = "two-gases";
          }
      }
    leakage.lower = std::min(leakage.lower, leakage.upper);
    // The rate is for one weight per cell, the bounds for the true weight of the gas.
    const double rate = std::clamp(std::abs(leakage.rate), leakage.lower, leakage.upper);
    leakage.rate      = gas.drive() < 0 ? -rate : rate;
  }
} // namespace strait
