// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/contact/contact_solver.h>
#include <strait/contact/grid_transfer.h>
#include <strait/contact/optimisers.h>
#include <strait/spectral/fill_windows.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace strait
{
  namespace
  {
    /** Residual on the coarser grids; their discretisation error is larger. With ten
     *  times this value a finest grid of 4096² points, where an FFT pair costs most,
     *  takes half as many pairs again; a tenth of it takes longer in all for a start that
     *  is no better. */
    constexpr double coarse_tolerance = 1e-3;

    /** Longest step of the load (or mean gap) that starts from the last states, relative
     *  to the last. With half of it some steps start from coarser grids that cost less
     *  from the last states, with double of it the reverse; the result is the same within
     *  the tolerance. */
    constexpr double longest_step = .12;

    /** Predict the pressure at @p target, which is near to @p from: on the line through
     *  the last two states if they are @p dry, or as that of @p from. Return nothing
     *  where coarser grids give a better start. */
    std::optional<SlabField>
    predict(const ContactState &from, const double target, const bool dry)
    {
      if (dry && std::abs(from.approach.steps_to(target)) <= 2.)
        return from.approach.extrapolated(from.pressure, target);
      // Rounds of contact and flow continue from each other, and a load that is solved
      // again continues from itself. Coarser grids know nothing of windows.
      if (!dry || target == from.approach.target() ||
          !from.pressure.layout().windows().empty())
        return from.pressure;
      return {};
    }
  } // namespace

  ContactSolver::ContactSolver(const ContactParameters &contact_parameters,
                               SlabField                surface_heights)
    : parameters(contact_parameters)
    , wall(std::move(surface_heights), parameters.effective_modulus)
    , problem(wall.heights, parameters.effective_modulus)
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
    // The load on the solid, or the prescribed mean gap.
    const double solid_target =
      parameters.is_load_controlled() ? target - wall.fluid_load : target;
    check(target, solid_target);

    // Only states under the same fluid lie on a line.
    const bool   is_dry = fluid_pressure == nullptr;
    const double before = from != nullptr ? from->approach.target() : 0.;
    const bool   is_next =
      from != nullptr && std::abs(solid_target - before) / before <= longest_step;
    // Windows around the throats of a distant load are of no use.
    const SlabLayoutPtr &layout = !is_dry   ? fluid_pressure->layout_pointer()
                                  : is_next ? from->pressure.layout_pointer()
                                            : wall.heights.layout_pointer();

    std::optional<SlabField> start;
    if (is_next)
      start = predict(*from, solid_target, is_dry);
    SlabField pressure = start ? std::move(*start) : start_without(layout, solid_target);
    SlabField gap(layout);
    DualProblem &contact = problem_on(layout, fluid_pressure);
    const double residual =
      digits == Digits::all ? parameters.tolerance : std::sqrt(parameters.tolerance);
    const long            n_before = contact.n_applications();
    const ContactSolution solution =
      optimise(contact, solid_target, residual, pressure, gap);
    problem.release();

    std::optional<PlasticState> plasticity;
    if (parameters.yields)
      plasticity =
        indent(indentation, pressure, gap, parameters.hardness, solution.converged);
    ContactState state = state_of(solution, std::move(pressure), std::move(gap));
    state.plasticity   = std::move(plasticity);
    if (parameters.is_load_controlled())
      state.nominal_pressure = target; // the mean without rounding
    state.fft_pairs = contact.n_applications() - n_before;
    if (is_next && is_dry)
      state.approach = solid_target == before
                         ? from->approach
                         : Approach(solid_target, from->pressure, before);
    else
      state.approach = Approach(solid_target);
    return state;
  }

  /** Return a start where no state near @p target is known. Collective. */
  SlabField
  ContactSolver::start_without(const SlabLayoutPtr &layout, const double target)
  {
    SlabField start = start_from_coarser_grid(wall.heights, target);
    if (layout->windows().empty())
      return start;
    // The other digits follow in the solution with windows.
    SlabField gap(wall.heights.layout_pointer());
    optimise(problem, target, std::sqrt(parameters.tolerance), start, gap);
    return zoom_in(start, layout->windows());
  }

  SlabField
  ContactSolver::cold_start(const SlabField &grid_heights, const double target) const
  {
    SlabField start(grid_heights.layout_pointer(), target);
    if (parameters.is_load_controlled())
      return start;
    // In proportion to the overlap of the undeformed surfaces.
    const double stiffness =
      parameters.effective_modulus / grid_heights.grid().mean_side();
    for (std::size_t i = 0; i < start.size(); ++i)
      start[i] = stiffness * std::max(0., grid_heights[i] - (target + wall.mean_height));
    return start;
  }

  SlabField
  ContactSolver::start_from_coarser_grid(const SlabField &fine_heights,
                                         const double     target)
  {
    if (!can_be_coarsened(fine_heights.grid()))
      return cold_start(fine_heights, target);

    const SlabField coarse_heights  = restrict_by_injection(fine_heights);
    SlabField       coarse_pressure = start_from_coarser_grid(coarse_heights, target);
    SlabField       coarse_gap(coarse_heights.layout_pointer());
    {
      HalfSpaceProblem coarse(coarse_heights, parameters.effective_modulus);
      optimise(coarse,
               target,
               std::max(parameters.tolerance, coarse_tolerance),
               coarse_pressure,
               coarse_gap);
    }

    // The interpolated contact is too wide: drop points next to an open gap.
    const SlabLayoutPtr &layout    = fine_heights.layout_pointer();
    SlabField            start     = prolong_bilinearly(coarse_pressure, layout);
    const SlabField      gap       = prolong_bilinearly(coarse_gap, layout);
    const double         spacing   = std::sqrt(layout->grid().dx() * layout->grid().dy());
    const double         steepness = 0.3 * parameters.effective_modulus / spacing;
    for (std::size_t i = 0; i < start.size(); ++i)
      if (!(start[i] > steepness * gap[i]))
        start[i] = 0;
    // The coarse grid may have missed a lone peak.
    return max_value(start) > 0 ? std::move(start) : cold_start(fine_heights, target);
  }

  /** Return the problem on the grid or, if @p layout has windows, on grid and windows. In
   *  the latter, a fluid of the pressure @p fluid_pressure displaces the half-space,
   *  unless that is null; on the grid, Wall::deform() has done this. Collective. */
  DualProblem &
  ContactSolver::problem_on(const SlabLayoutPtr &layout, const SlabField *fluid_pressure)
  {
    if (layout->windows().empty())
      {
        zoomed.reset();
        zoomed_wall.reset();
        return problem;
      }
    if (zoomed == nullptr ||
        !(zoomed_wall->heights.layout().windows() == layout->windows()))
      {
        zoomed.reset(); // before the next one needs its memory
        SlabField heights(layout);
        std::copy(wall.at_rest().begin(), wall.at_rest().end(), heights.begin());
        fill_windows(heights);
        zoomed_wall.emplace(std::move(heights), parameters.effective_modulus);
        zoomed = std::make_unique<ZoomedProblem>(zoomed_wall->heights,
                                                 parameters.effective_modulus);
      }
    zoomed_wall->deform(fluid_pressure);
    return *zoomed;
  }

  void
  ContactSolver::check(const double target, const double solid_target) const
  {
    if (!(target > 0) || !std::isfinite(target))
      throw InputError(format("Load programme/Pressures contains %g but a %s",
                              target,
                              parameters.is_load_controlled()
                                ? "nominal pressure must be positive: without a load "
                                  "the surfaces never make contact."
                                : "mean gap must be positive: it is 0 only under an "
                                  "infinite load."));
    if (parameters.yields && !(target < parameters.hardness))
      throw InputError(
        format("At a nominal pressure of %g all of the contact flows: it "
               "must be less than Contact/Hardness = %g.",
               target,
               parameters.hardness));
    if (!(solid_target > 0))
      throw ComputationError(
        format("The fluid carries a mean pressure of %g, more than the nominal pressure "
               "of %g, so the surfaces do not stay in contact.",
               wall.fluid_load,
               target));
  }

  /** Solve @p on_grid to the tolerance @p residual, in units of the rms height.
   *  Collective. */
  ContactSolution
  ContactSolver::optimise(DualProblem &on_grid,
                          const double target,
                          const double residual,
                          SlabField   &grid_pressure,
                          SlabField   &grid_gap)
  {
    // A flat surface has no rms height. Its only error is rounding of the displacement
    // that the load would cause over the box.
    const double length = wall.rms_height > 0 ? wall.rms_height
                                              : target * wall.heights.grid().mean_side() /
                                                  parameters.effective_modulus;
    // Displacements G p have the mean 0: u0 is the mean gap plus the mean height.
    const double held =
      parameters.is_load_controlled() ? target : target + wall.mean_height;
    return find_pressure(
      parameters.method,
      {on_grid,
       {parameters.is_load_controlled(), held, parameters.largest_pressure()},
       {residual, length, parameters.maximum_iterations},
       grid_pressure.data(),
       grid_gap.data()});
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

    ContactState state(std::move(pressure),
                       std::move(gap),
                       parameters.largest_pressure());
    static_cast<ContactSolution &>(state) = solution;
    state.nominal_pressure                = mean(state.pressure) + wall.fluid_load;
    return state;
  }
} // namespace strait
