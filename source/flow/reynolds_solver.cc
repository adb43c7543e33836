// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/reynolds_solver.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // The relative effect of rounding on bounds of the same quantity. If the solver
    // failed, they would be wrong by far more; half and double of it decide alike.
    constexpr double noise_of_bounds = 1e-6;

    // While a barrier or a channel is being resolved, the bracket may stay as wide for a
    // mesh or two before it narrows again, and for more before cells are as small as the
    // spacing. Half of the patience gives up during that time; double of it makes more
    // meshes in vain where the grid is too coarse.
    constexpr std::size_t patience = 4;

    // How much narrower a bracket is with hierarchical correction: by 2 to 3.5. Half of
    // it makes meshes that correction would save, and finer ones than asked; double of it
    // corrects in vain, and takes more meshes.
    constexpr double usual_narrowing = 2.5;

    // More accuracy than the target must not cost more than this many times the unknowns
    // that the target took. Half of it ends the search for a narrower bracket earlier,
    // double of it makes it up to twice as expensive.
    constexpr unsigned long long most_growth = 8;

    /** Whether the bounds enclose a leak rate, up to rounding. */
    bool
    is_bracket(const Leakage &leakage)
    {
      return leakage.mesh_lower > 0 &&
             leakage.mesh_lower <= leakage.mesh_upper * (1 + noise_of_bounds);
    }
  } // namespace

  ReynoldsSolver::ReynoldsSolver(const FluidParameters &fluid,
                                 const GapField        &gap,
                                 const SealMesh        *seal)
    : parameters(fluid)
    , gap_field(gap)
    , pressure_drop(fluid.inlet_pressure - fluid.outlet_pressure)
    , flow_mesh(gap, fluid.direction, seal)
    , pressure_problem(flow_mesh, gap.moment_set(), GapField::Coefficient::conductivity)
    , stream_problem(flow_mesh, gap.moment_set(), GapField::Coefficient::resistivity)
  {
  }

  Leakage
  ReynoldsSolver::run(const Channel           &channel,
                      const Observer          &observer,
                      const double             tolerance_factor,
                      const unsigned long long most_unknowns)
  {
    const double target = parameters.target_accuracy, wanted = tolerance_factor * target;
    // Only elements of degree 1 are corrected.
    const double narrowing    = parameters.element_degree == 1 ? usual_narrowing : 1.;
    bool         is_corrected = false;
    Leakage      leakage;
    leakage.linear_error = accuracy().energy;
    widths.clear();
    while (true)
      {
        const bool solved = solve_on_mesh(leakage);
        // Correction is half of the work and decides nothing while the bracket is far
        // wider than any width that matters.
        const double decisive = unknowns_needed == 0 ? std::max(wanted, target) : wanted;
        const double plain_width = 1. - plain.lower / plain.upper;
        is_corrected             = is_corrected || plain_width <= narrowing * decisive;
        take_bracket(is_corrected ? corrected_bracket() : plain, leakage);
        if (observer)
          observer(leakage);
        if (!is_bracket(leakage))
          {
            leakage.status = "flow-bracket";
            break;
          }
        const double width = leakage.relative_width();
        if (unknowns_needed == 0 && width <= target)
          unknowns_needed = leakage.unknowns;
        const bool is_done =
          width <= wanted || leakage.unknowns > most_unknowns ||
          (width <= target && leakage.unknowns > most_growth * unknowns_needed);
        std::string reason = is_done ? "" : reason_to_stop(leakage);
        if (!is_done && reason.empty())
          {
            const double excess =
              1. - wanted / (is_corrected ? width : plain_width / narrowing);
            if (refine(leakage.unknowns, channel, excess))
              {
                ++leakage.refinements;
                continue;
              }
            reason = "it takes more than Fluid/Maximum unknowns";
          }
        if (!is_corrected)
          take_bracket(corrected_bracket(), leakage);
        // Missing only the smaller tolerance is no failure.
        if (!is_done && leakage.relative_width() > target)
          {
            leakage.reason = reason;
            leakage.status = solved ? "flow-accuracy" : "flow-solver";
          }
        break;
      }
    if (gap_field.gas() != nullptr)
      bound_rarefied(channel.paths.front(), leakage);
    return leakage;
  }

  LinearAccuracy
  ReynoldsSolver::accuracy() const
  {
    // The error of an energy is the square of that of its potential. Double of it saves
    // and half of it costs a fraction of an iteration; neither changes the bounds.
    return {parameters.preconditioner,
            noise_of_bounds * noise_of_bounds * parameters.target_accuracy};
  }

  LinearSolve
  ReynoldsSolver::solve(PotentialProblem &problem)
  {
    if (gap_field.gas() != nullptr && &problem == &pressure_problem)
      return solve_rarefied();
    problem.take_coefficient(gap_field);
    problem.set_weights(pressure_problem.weights());
    return problem.solve(accuracy());
  }

  /** Return the factor from a conductance to a leak rate. */
  double
  ReynoldsSolver::drive() const
  {
    return gap_field.gas() != nullptr ? gap_field.gas()->drive() : pressure_drop;
  }

  double
  ReynoldsSolver::pressure_at(const double potential) const
  {
    if (gap_field.gas() != nullptr)
      return gap_field.gas()->pressure(potential);
    const double low = parameters.outlet_pressure, high = parameters.inlet_pressure;
    // The density of a gas rises with its pressure, so that its potential is p².
    return parameters.is_gas
             ? std::sqrt(std::max(0., low * low + (high * high - low * low) * potential))
             : low + pressure_drop * potential;
  }

  double
  ReynoldsSolver::solve_pressure()
  {
    solve(pressure_problem);
    return pressure_problem.energy() * std::abs(pressure_drop);
  }

  double
  ReynoldsSolver::change_in(const GapField &other)
  {
    // Cells too coarse for the other gap raise both energies, but hardly their quotient.
    double change = 1.;
    for (const PotentialProblem *problem : {&pressure_problem, &stream_problem})
      {
        PotentialProblem changed(flow_mesh,
                                 other.moment_set(),
                                 problem->coefficient_kind());
        changed.take_coefficient(other);
        changed.set_weights(pressure_problem.weights());
        changed.start_from(*problem);
        if (!changed.solve(accuracy()).converged)
          return std::numeric_limits<double>::infinity();
        const double ratio = std::sqrt(changed.energy() / problem->energy());
        change *= problem->is_pressure() ? ratio : 1. / ratio;
      }
    return change - 1.;
  }

  bool
  ReynoldsSolver::solve_on_mesh(Leakage &leakage)
  {
    bool solved = true;
    for (PotentialProblem *problem : {&pressure_problem, &stream_problem})
      {
        const LinearSolve outcome = solve(*problem);
        leakage.iterations += outcome.iterations;
        solved = solved && outcome.converged;
      }
    plain            = plain_bracket(pressure_problem, stream_problem);
    leakage.cells    = flow_mesh.triangulation().n_global_active_cells();
    leakage.unknowns = pressure_problem.n_unknowns() + stream_problem.n_unknowns();
    return solved;
  }

  Bracket
  ReynoldsSolver::corrected_bracket() const
  {
    if (parameters.element_degree != 1)
      return plain;
    // Correction narrows the bracket that decides when to stop. The shares of cells in it
    // are no guide for refinement: the correction closes a short cut through a coarse
    // cell only after the pressure around has adjusted to it.
    const HierarchicalCorrection correction(flow_mesh);
    Bracket                      corrected;
    corrected.upper = correction.relax(pressure_problem, gap_field);
    corrected.lower = 1. / correction.relax(stream_problem, gap_field);
    return corrected;
  }

  void
  ReynoldsSolver::take_bracket(const Bracket &bracket, Leakage &leakage) const
  {
    leakage.mesh_lower = bracket.lower * std::abs(drive());
    leakage.mesh_upper = bracket.upper * std::abs(drive());
    // A bound of an earlier mesh still holds, even if the solver fails on this one,
    // unless its cells were so coarse that it contradicts this one.
    const bool first = leakage.upper == 0;
    const bool fit   = leakage.mesh_lower <= leakage.upper * (1 + noise_of_bounds) &&
                     leakage.mesh_upper * (1 + noise_of_bounds) >= leakage.lower;
    // For a rarefied gas they only hold for the weights of their mesh.
    if (first || !fit || gap_field.gas() != nullptr)
      {
        leakage.upper = leakage.mesh_upper;
        leakage.lower = leakage.mesh_lower;
      }
    leakage.upper = std::min(leakage.upper, leakage.mesh_upper);
    leakage.lower = std::max(leakage.lower, leakage.mesh_lower);
    // In a wide bracket the upper bound is nearer: the lower one still lacks a channel.
    const double best = 2. * leakage.lower < leakage.upper
                          ? leakage.upper
                          : std::sqrt(leakage.upper) * std::sqrt(leakage.lower);
    leakage.rate      = pressure_drop < 0 ? -best : best;
  }

  std::string
  ReynoldsSolver::reason_to_stop(const Leakage &leakage)
  {
    if (flow_mesh.reaches_spacing())
      widths.push_back(std::log(leakage.upper / leakage.lower));
    if (!flow_mesh.can_be_refined())
      return "the smallest cells cannot be divided any further";
    if (widths.size() > patience &&
        widths.back() > useful_narrowing * widths[widths.size() - 1 - patience])
      return "the bracket no longer narrows: the grid of the contact does not resolve "
             "the narrowest constriction";
    return {};
  }

  bool
  ReynoldsSolver::refine(const unsigned long long unknowns,
                         const Channel           &channel,
                         const double             excess)
  {
    // Each marked cell adds three; balancing the mesh adds a few more.
    const double affordable =
      (static_cast<double>(parameters.maximum_unknowns) / unknowns - 1.) / 3.;
    auto &tria = flow_mesh.triangulation();
    if (parameters.uniform_refinement && affordable >= 1.)
      tria.set_all_refine_flags();
    else if (parameters.uniform_refinement || !mark(channel, excess, affordable))
      return false;
    tria.prepare_coarsening_and_refinement();
    pressure_problem.prepare_for_refinement();
    stream_problem.prepare_for_refinement();
    tria.execute_coarsening_and_refinement();
    return true;
  }
} // namespace strait
