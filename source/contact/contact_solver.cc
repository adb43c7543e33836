// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/contact/contact_area.h>
#include <strait/contact/contact_solver.h>
#include <strait/spectral/fill_windows.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Whether a state at @p target may start from @p from. */
    bool
    is_near(const ContactState &from, const double target)
    {
      // Largest relative step of the load that starts from the last states: beyond it
      // the coarser grids cost less (measured on self-affine surfaces). Half of it sends
      // steps to the coarser grids that are shorter from the last state, double of it the
      // other way round; the result is the same within the tolerance.
      constexpr double small_step = 0.12;
      const double     before     = from.approach.target();
      return before > 0 && std::abs(target - before) <= small_step * before;
    }

    /** The pressure at @p target, foretold from states near to it. */
    SlabField
    start_from(const ContactState &from, const double target, const bool on_a_line)
    {
      return on_a_line && std::abs(from.approach.steps_to(target)) <= 2.
               ? from.approach.extrapolated(from.pressure, target)
               : from.pressure;
    }
  } // namespace

  ContactSolver::ContactSolver(const ContactParameters &contact_parameters,
                               SlabField                surface_heights)
    : parameters(contact_parameters)
    , wall(std::move(surface_heights), parameters.effective_modulus)
    , problem(wall.heights(), parameters.effective_modulus)
  {
  }

  ContactState
  ContactSolver::solve(const double        target,
                       const ContactState *from,
                       const SlabField    *fluid_pressure,
                       const Digits        digits)
  {
    const SlabField *indentation =
      from != nullptr && from->plasticity ? &from->plasticity->indentation : nullptr;
    wall.deform(fluid_pressure, indentation);
    check(target);
    if (!makes_contact(target))
      return state_without_contact(target);

    const double of_solid = share_of_solid(target);
    // Only states under the same fluid lie on a line.
    const bool is_dry = fluid_pressure == nullptr;
    const bool starts = from != nullptr && is_near(*from, of_solid);
    // A state that was never solved has neither fields nor windows.
    const SlabLayoutPtr &layout = from != nullptr && !from->pressure.empty()
                                    ? from->pressure.layout_pointer()
                                    : wall.layout();
    SlabField            pressure =
      starts ? start_from(*from, of_solid, is_dry) : start_without(layout, of_solid);
    SlabField              gap(layout);
    DualProblem           &contact   = problem_on(layout);
    const ContactTolerance tolerance = tolerance_for(of_solid, digits);
    const long             n_before  = contact.n_applications();
    const ContactSolution  solution =
      optimise(contact, of_solid, tolerance, pressure, gap);
    problem.release();

    std::optional<PlasticState> plasticity;
    if (parameters.yields())
      plasticity =
        indent(indentation, pressure, gap, parameters.hardness, solution.converged);
    ContactState state = state_of(solution, std::move(pressure), std::move(gap));
    state.plasticity   = std::move(plasticity);
    if (parameters.loads())
      state.nominal_pressure = target; // the mean, without its rounding
    state.fft_pairs = contact.n_applications() - n_before;
    if (starts && is_dry)
      state.approach = of_solid == from->approach.target()
                         ? from->approach
                         : Approach(of_solid, from->pressure, from->approach.target());
    else
      state.approach = Approach(of_solid);
    return state;
  }

  /** The problem on the grid, or with the windows of @p layout as well. Collective. */
  DualProblem &
  ContactSolver::problem_on(const SlabLayoutPtr &layout)
  {
    if (layout->windows().empty())
      {
        zoomed.reset();
        zoomed_heights = SlabField();
        return problem;
      }
    if (zoomed == nullptr || !(zoomed_heights.layout().windows() == layout->windows()))
      {
        zoomed.reset(); // before the next one needs its memory
        zoomed_heights = SlabField(layout);
        std::copy(wall.heights().begin(), wall.heights().end(), zoomed_heights.begin());
        fill_windows(zoomed_heights);
        zoomed =
          std::make_unique<ZoomedProblem>(zoomed_heights, parameters.effective_modulus);
      }
    return *zoomed;
  }

  void
  ContactSolver::check(const double target) const
  {
    if (!(target > 0) || !std::isfinite(target))
      throw InputError(format("Load programme/Pressures contains %g but a %s",
                              target,
                              parameters.loads()
                                ? "nominal pressure must be positive: without a load "
                                  "the surfaces never make contact."
                                : "mean gap must be positive: it is 0 only under an "
                                  "infinite load."));
    if (parameters.yields() && !(target < parameters.hardness))
      throw InputError(
        format("At a nominal pressure of %g all of the contact flows: it "
               "must be less than Contact/Hardness = %g.",
               target,
               parameters.hardness));
    if (!(share_of_solid(target) > 0))
      throw ComputationError(
        format("The fluid carries a mean pressure of %g, more than the nominal pressure "
               "of %g, so the surfaces do not stay in contact.",
               wall.fluid_load(),
               target));
  }

  bool
  ContactSolver::makes_contact(const double target) const
  {
    // The highest peak has height 0 here.
    return parameters.loads() || target + wall.mean_height() < 0;
  }

  double
  ContactSolver::share_of_solid(const double target) const
  {
    return parameters.loads() ? target - wall.fluid_load() : target;
  }

  ContactConstraint
  ContactSolver::constraint_for(const double target) const
  {
    // The displacement under pressure has the mean 0.
    if (!parameters.loads())
      return ContactConstraint::rigid_displacement(target + wall.mean_height());
    return parameters.yields()
             ? ContactConstraint::mean_pressure(target, parameters.hardness)
             : ContactConstraint::mean_pressure(target);
  }

  ContactTolerance
  ContactSolver::tolerance_for(const double target, const Digits digits) const
  {
    // A flat surface has no rms height; what remains is rounding of the
    // displacement that the load itself would cause over the box.
    const double length =
      wall.rms_height() > 0
        ? wall.rms_height()
        : target * wall.heights().grid().mean_side() / parameters.effective_modulus;
    return {digits == Digits::all ? parameters.tolerance
                                  : std::sqrt(parameters.tolerance),
            length,
            parameters.maximum_iterations};
  }

  ContactSolution
  ContactSolver::optimise(DualProblem            &on_grid,
                          const double            target,
                          const ContactTolerance &tolerance,
                          SlabField              &grid_pressure,
                          SlabField              &grid_gap)
  {
    const auto optimiser =
      make_dual_optimiser(parameters.method, on_grid, constraint_for(target), tolerance);
    return optimiser->solve(grid_pressure.data(), grid_gap.data());
  }

  ContactState
  ContactSolver::state_of(const ContactSolution &solution,
                          SlabField              pressure,
                          SlabField              gap) const
  {
    for (std::size_t i = 0; i < gap.size(); ++i)
      gap[i] = pressure[i] > 0 ? 0. : std::max(gap[i], 0.);
    copy_to_covered(pressure);
    copy_to_covered(gap);

    const ContactArea area = contact_area(pressure);
    ContactState      state;
    state.pressure               = std::move(pressure);
    state.gap                    = std::move(gap);
    state.nominal_pressure       = mean(state.pressure) + wall.fluid_load();
    state.mean_gap               = mean(state.gap);
    state.contact_area           = area.fraction;
    state.contact_area_corrected = area.corrected_fraction;
    state.residual               = solution.residual;
    state.iterations             = solution.iterations;
    state.converged              = solution.converged;
    return state;
  }

  ContactState
  ContactSolver::state_without_contact(const double mean_gap) const
  {
    ContactState state;
    state.nominal_pressure = wall.fluid_load();
    state.pressure         = SlabField(wall.layout());
    state.gap              = SlabField(wall.layout());
    for (std::size_t i = 0; i < state.gap.size(); ++i)
      state.gap[i] = std::max(0., mean_gap + wall.mean_height() - wall.heights()[i]);
    state.mean_gap  = mean(state.gap);
    state.converged = true;
    return state;
  }
} // namespace strait
