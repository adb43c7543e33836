// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/critical_cells.h>

#include <deal.II/distributed/grid_refinement.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    // A cell is refined if its share exceeds this part of the mean one.
    constexpr double marking_level = .7;
  } // namespace

  ReynoldsSolver::ReynoldsSolver(const FluidParameters       &fluid,
                                 const GapField              &gap,
                                 const std::vector<FlowPath> &paths,
                                 const SealMesh              *seal)
    : parameters(fluid)
    , gap_field(gap)
    , pressure_drop(fluid.inlet_pressure - fluid.outlet_pressure)
    , flow_mesh(gap, fluid.direction, seal)
    , pressure_problem(PotentialProblem::Kind::pressure, flow_mesh, gap.moment_set())
    , stream_problem(PotentialProblem::Kind::stream_function, flow_mesh, gap.moment_set())
  {
    constexpr int start_exponent = 4;
    if (fluid.element_degree == 1)
      enrichment = std::make_unique<Enrichment>(flow_mesh);
    if (fluid.refinement == Refinement::adaptive)
      flow_mesh.refine_initially(largest_start_exponent(flow_mesh.grid()),
                                 paths.empty() ? std::vector<GridCell>()
                                               : paths.front().critical_cells);
    else
      flow_mesh.refine_uniformly(start_exponent);
  }

  FlowResult
  ReynoldsSolver::run(const Observer          &observer,
                      const double             share,
                      const unsigned long long most_unknowns)
  {
    FlowResult result;
    widths.clear();
    while (true)
      {
        const bool solved = solve_on_mesh(result);
        if (observer)
          observer(result);
        if (!(result.mesh_lower > 0 &&
              result.mesh_lower <= result.mesh_upper * (1 + 1e-6)))
          {
            result.status = "flow-bracket";
            return result;
          }
        if (unknowns_needed == 0 && result.relative_width() <= parameters.target_accuracy)
          unknowns_needed = result.unknowns;
        if (result.relative_width() <= share * parameters.target_accuracy ||
            is_enough(result) || result.unknowns > most_unknowns)
          return result;
        result.reason = obstacle(result);
        if (result.reason.empty() && !refine(result))
          result.reason = "it takes more than Fluid/Maximum unknowns";
        if (!result.reason.empty())
          {
            if (result.relative_width() <= parameters.target_accuracy)
              result.reason.clear(); // only the share was missed
            else
              result.status = solved ? "flow-accuracy" : "flow-solver";
            return result;
          }
        ++result.refinements;
      }
  }

  /** Whether more than the target accuracy would cost too much. */
  bool
  ReynoldsSolver::is_enough(const FlowResult &result) const
  {
    constexpr unsigned long long most_growth = 8;
    return result.relative_width() <= parameters.target_accuracy &&
           result.unknowns > most_growth * unknowns_needed;
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
    plain = plain_bracket(flow_mesh, pressure_problem, stream_problem);
    Bracket closest;
    if (enrichment)
      closest = enriched_bracket(
        flow_mesh, gap_field, pressure_problem, stream_problem, *enrichment);
    else
      {
        closest = plain;
        allow_for_quadrature(
          closest, flow_mesh, gap_field, pressure_problem, stream_problem);
      }
    // Where the coefficients are not integrated well enough cells must be smaller.
    if (closest.quadrature_errors.size() > 0)
      plain.shares += closest.quadrature_errors;

    const double drop = std::abs(pressure_drop);
    result.mesh_upper = closest.safe_upper * drop;
    result.mesh_lower = closest.safe_lower * drop;
    // A bound of an earlier mesh still holds, should the solver fail on this one,
    // unless its cells were so coarse that it contradicts this one.
    const bool first = result.upper == 0;
    const bool fit   = result.mesh_lower <= result.upper * (1 + 1e-6) &&
                     result.mesh_upper * (1 + 1e-6) >= result.lower;
    if (first || !fit)
      {
        result.upper = result.mesh_upper;
        result.lower = result.mesh_lower;
      }
    result.upper = std::min(result.upper, result.mesh_upper);
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

  std::string
  ReynoldsSolver::obstacle(const FlowResult &result)
  {
    constexpr unsigned int max_refinements = 40;
    // While a barrier or a channel is being resolved the bracket may rest for a mesh
    // or two before it narrows again.
    constexpr std::size_t patience = 4;
    constexpr double      progress = .97;
    // Below this the next meshes cost next to nothing, and may yet find the channel.
    constexpr unsigned long long many_unknowns = 50000;
    widths.push_back(result.relative_width());
    if (result.refinements == max_refinements)
      return "the mesh was refined " + std::to_string(max_refinements) + " times";
    if (result.unknowns > many_unknowns && widths.size() > patience &&
        widths.back() > progress * widths[widths.size() - 1 - patience])
      return "the bracket no longer narrows: the grid of the contact does not resolve "
             "the narrowest constriction";
    return {};
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
        const double total =
          dealii::Utilities::MPI::sum(plain.shares.l1_norm(), tria.get_communicator());
        const double level = marking_level * total / static_cast<double>(result.cells);
        for (const auto &cell : tria.active_cell_iterators())
          if (cell->is_locally_owned() && plain.shares(cell->active_cell_index()) > level)
            cell->set_refine_flag();
        unsigned long long n_marked = 0;
        for (const auto &cell : tria.active_cell_iterators())
          n_marked += cell->is_locally_owned() && cell->refine_flag_set() ? 1 : 0;
        n_marked = dealii::Utilities::MPI::sum(n_marked, tria.get_communicator());
        if (n_marked == 0 || affordable < least_share)
          return false;
        // Where most cells matter alike, adaptivity saves nothing and costs hanging
        // nodes and meshes.
        constexpr double most_cells = .5;
        if (n_marked > most_cells * static_cast<double>(result.cells) && affordable > 1.)
          tria.set_all_refine_flags();
        else if (n_marked > affordable * result.cells)
          {
            for (const auto &cell : tria.active_cell_iterators())
              cell->clear_refine_flag();
            refinement::refine_and_coarsen_fixed_number(tria,
                                                        plain.shares,
                                                        affordable,
                                                        0.);
          }
      }
    tria.prepare_coarsening_and_refinement();
    pressure_problem.prepare_for_refinement();
    stream_problem.prepare_for_refinement();
    tria.execute_coarsening_and_refinement();
    return true;
  }
} // namespace strait
