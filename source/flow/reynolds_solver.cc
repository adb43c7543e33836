// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/reynolds_solver.h>

#include <deal.II/distributed/grid_refinement.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // How much smaller than the bracket the error of the linear solver must be.
    constexpr double linear_share = 1e-6;
    constexpr double marked_share = 0.8;
  } // namespace

  ReynoldsSolver::ReynoldsSolver(const FluidParameters       &fluid,
                                 const GapField              &gap,
                                 const std::vector<FlowPath> &paths)
    : parameters(fluid)
    , gap_field(gap)
    , pressure_drop(fluid.inlet_pressure - fluid.outlet_pressure)
    , flow_mesh(gap, fluid.direction)
    , pressure_problem(PotentialProblem::Kind::pressure, flow_mesh, gap.moment_set())
    , stream_problem(PotentialProblem::Kind::stream_function, flow_mesh, gap.moment_set())
  {
    constexpr int start_exponent = 4;
    if (fluid.refinement == Refinement::adaptive)
      flow_mesh.refine_initially(gap, paths);
    else
      flow_mesh.refine_uniformly(start_exponent);
  }

  FlowResult
  ReynoldsSolver::run(const Observer &observer)
  {
    constexpr unsigned int max_refinements = 40;
    FlowResult             result;
    while (true)
      {
        const bool solved = solve_on_mesh(result);
        if (observer)
          observer(result);
        // Bounds of two meshes contradict each other where cells are too coarse for
        // their integrals over a throat.
        if (!(result.mesh_lower > 0 &&
              result.mesh_lower <= result.mesh_upper * (1 + 1e-6) &&
              result.lower <= result.upper * (1 + 1e-6)))
          {
            result.status = "flow-bracket";
            return result;
          }
        if (result.relative_width() <= parameters.target_accuracy)
          return result;
        if (result.refinements == max_refinements || !refine(result))
          {
            result.status = solved ? "flow-accuracy" : "flow-solver";
            return result;
          }
        ++result.refinements;
      }
  }

  LinearSolve
  ReynoldsSolver::solve(PotentialProblem &problem)
  {
    problem.set_up();
    problem.assemble(gap_field);
    return problem.solve(parameters.preconditioner,
                         linear_share * parameters.target_accuracy);
  }

  double
  ReynoldsSolver::solve_pressure()
  {
    solve(pressure_problem);
    return pressure_problem.energy() * std::abs(pressure_drop);
  }

  bool
  ReynoldsSolver::solve_on_mesh(FlowResult &result)
  {
    bool solved = true;
    for (PotentialProblem *problem : {&pressure_problem, &stream_problem})
      {
        const LinearSolve outcome = solve(*problem);
        result.iterations += outcome.iterations;
        solved = solved && outcome.converged;
      }
    const double conductance_upper = pressure_problem.energy();
    const double conductance_lower = 1. / stream_problem.energy();
    shares                         = indicator(conductance_lower, conductance_upper);

    const double drop = std::abs(pressure_drop);
    result.mesh_upper = conductance_upper * drop;
    result.mesh_lower = conductance_lower * drop;
    // A bound of an earlier mesh still holds, should the solver fail on this one.
    const bool first = result.upper == 0;
    result.upper = first ? result.mesh_upper : std::min(result.upper, result.mesh_upper);
    result.lower = std::max(result.lower, result.mesh_lower);
    // Of a wide bracket the upper end is nearer: the lower bound waits for a channel.
    const double best = 2. * result.lower < result.upper
                          ? result.upper
                          : std::sqrt(result.upper) * std::sqrt(result.lower);
    result.leak_rate  = pressure_drop < 0 ? -best : best;
    result.cells      = flow_mesh.triangulation().n_global_active_cells();
    result.unknowns   = pressure_problem.n_unknowns() + stream_problem.n_unknowns();
    return solved;
  }

  dealii::Vector<float>
  ReynoldsSolver::indicator(const double conductance_lower,
                            const double conductance_upper) const
  {
    dealii::Vector<float> result(flow_mesh.triangulation().n_active_cells());
    std::vector<double>   p, psi;
    std::size_t           c           = 0;
    auto                  cell        = pressure_problem.dof_handler().begin_active();
    auto                  cell_of_psi = stream_problem.dof_handler().begin_active();
    for (; cell != pressure_problem.dof_handler().end(); ++cell, ++cell_of_psi)
      if (cell->is_locally_owned())
        {
          const std::size_t here = c++;
          pressure_problem.cell_values(cell, p);
          stream_problem.cell_values(cell_of_psi, psi);
          double share =
            conductance_lower * conductance_lower * stream_problem.cell_energy(here, psi);
          if (pressure_problem.is_active(here))
            share += pressure_problem.cell_energy(here, p) +
                     2. * conductance_lower *
                       pressure_problem.element_matrix().gradient_times_curl(p, psi);
          result(cell->active_cell_index()) =
            static_cast<float>(std::max(share / conductance_upper, 0.));
        }
    return result;
  }

  bool
  ReynoldsSolver::refine(const FlowResult &result)
  {
    namespace refinement = dealii::parallel::distributed::GridRefinement;
    // Each marked cell adds three; a few more come from balancing the mesh.
    constexpr double least_share = .02;
    const double     affordable =
      (static_cast<double>(parameters.maximum_unknowns) / result.unknowns - 1.) / 3.;
    auto &tria = flow_mesh.triangulation();
    if (parameters.refinement == Refinement::uniform)
      {
        if (affordable < 1.)
          return false;
        tria.set_all_refine_flags();
      }
    else
      {
        refinement::refine_and_coarsen_fixed_fraction(tria, shares, marked_share, 0.);
        unsigned long long n_marked = 0;
        for (const auto &cell : tria.active_cell_iterators())
          n_marked += cell->is_locally_owned() && cell->refine_flag_set() ? 1 : 0;
        n_marked = dealii::Utilities::MPI::sum(n_marked, tria.get_communicator());
        if (n_marked == 0 || affordable < least_share)
          return false;
        if (n_marked > affordable * result.cells)
          {
            for (const auto &cell : tria.active_cell_iterators())
              cell->clear_refine_flag();
            refinement::refine_and_coarsen_fixed_number(tria, shares, affordable, 0.);
          }
      }
    tria.prepare_coarsening_and_refinement();
    pressure_problem.prepare_for_refinement();
    stream_problem.prepare_for_refinement();
    tria.execute_coarsening_and_refinement();
    return true;
  }
} // namespace strait
