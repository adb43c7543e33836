// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/contact_solver.h>
#include <strait/contact/grid_transfer.h>
#include <strait/contact/zoom_in.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Residual on the coarser grids: their discretisation error is larger. Half of it
     *  takes a little longer there for a start that is no better, double of it leaves
     * more to the finest grid, where an iteration costs most. */
    constexpr double coarse_tolerance = 1e-3;
  } // namespace

  /** A start without a state near to it. Collective. */
  SlabField
  ContactSolver::start_without(const SlabLayoutPtr &layout, const double target)
  {
    SlabField start = start_from_coarser_grid(wall.heights(), target);
    if (layout->windows().empty())
      return start;
    // All digits come with the windows.
    SlabField gap(wall.layout());
    optimise(problem, target, tolerance_for(target, Digits::half), start, gap);
    return zoom_in(start, layout->windows());
  }

  SlabField
  ContactSolver::cold_start(const SlabField &grid_heights, const double target) const
  {
    SlabField start(grid_heights.layout_pointer(), target);
    if (!parameters.loads())
      {
        // Where the surfaces would overlap, in proportion to the overlap.
        const double stiffness =
          parameters.effective_modulus / grid_heights.grid().mean_side();
        for (std::size_t i = 0; i < start.size(); ++i)
          start[i] =
            stiffness * std::max(0., grid_heights[i] - (target + wall.mean_height()));
      }
    return start;
  }

  SlabField
  ContactSolver::start_from_coarser_grid(const SlabField &fine_heights,
                                         const double     target)
  {
    if (!can_be_coarsened(fine_heights.grid()))
      return cold_start(fine_heights, target);

    const SlabField  coarse_heights  = restrict_by_injection(fine_heights);
    SlabField        coarse_pressure = start_from_coarser_grid(coarse_heights, target);
    SlabField        coarse_gap(coarse_heights.layout_pointer());
    ContactTolerance tolerance = tolerance_for(target);
    tolerance.residual         = std::max(tolerance.residual, coarse_tolerance);
    {
      HalfSpaceProblem coarse(coarse_heights, parameters.effective_modulus);
      optimise(coarse, target, tolerance, coarse_pressure, coarse_gap);
    }

    // Interpolated contact is too wide: drop what is next to an open gap.
    const SlabLayoutPtr &layout    = fine_heights.layout_pointer();
    SlabField            start     = prolong_bilinearly(coarse_pressure, layout);
    const SlabField      gap       = prolong_bilinearly(coarse_gap, layout);
    const double         spacing   = std::sqrt(layout->grid().dx() * layout->grid().dy());
    const double         steepness = 0.3 * parameters.effective_modulus / spacing;
    for (std::size_t i = 0; i < start.size(); ++i)
      if (!(start[i] > steepness * gap[i]))
        start[i] = 0;
    // On a coarse grid a lone peak may have been missed.
    return max_value(start) > 0 ? std::move(start) : cold_start(fine_heights, target);
  }
} // namespace strait
