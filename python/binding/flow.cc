// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/reynolds_solver.h>
#include <strait/flow/solution_on_grid.h>
#include <strait/percolation/bottleneck.h>

#include <cmath>

#include "bindings.h"

namespace strait::python
{
  namespace
  {
    /** The transformed values of @p whole, which rank 0 has, at the grid points where
     *  @p flow leaks; elsewhere not a number. Collective. */
    template <typename Transform>
    SlabField
    where_it_leaks(const Flow               &flow,
                   const std::vector<float> &whole,
                   const Transform          &transform)
    {
      SlabField field =
        scatter_from_root(flow.layout, std::vector<double>(whole.begin(), whole.end()));
      constexpr auto leaks = static_cast<std::uint8_t>(NodeState::percolating);
      for (std::size_t k = 0; k < field.size(); ++k)
        field[k] = flow.clusters[k] == leaks ? transform(field[k])
                                             : std::numeric_limits<double>::quiet_NaN();
      return field;
    }
  } // namespace

  std::shared_ptr<Flow>
  record_of(const StepFlow        &flow,
            const SlabLayout      &points,
            const SlabLayoutPtr   &grid,
            const FluidParameters &fluid)
  {
    auto result           = std::make_shared<Flow>();
    result->leakage       = flow.leakage;
    result->percolates    = flow.channel.percolates();
    result->effective_gap = effective_gap(flow.leakage, fluid);
    result->layout        = grid;
    for (std::size_t k = 0; k < grid->n_values(); ++k)
      result->clusters.push_back(
        static_cast<std::uint8_t>(flow.channel.clusters.states[k]));
    if (!flow.channel.paths.empty())
      {
        const FlowPath &path = flow.channel.paths.front();
        const auto [x, y]    = position_of(points, path.bottleneck);
        result->x            = x;
        result->y            = y;
        result->gap          = path.bottleneck_gap;
      }
    return result;
  }

  void
  add_fields(Flow &flow, const ReynoldsSolver &solver)
  {
    const double       rate = std::abs(flow.leakage.rate);
    const FlowAtPoints fields =
      flow_at_points(solver, rows_of_grid(flow.layout->grid(), 1));
    flow.pressure = where_it_leaks(flow, fields.pressure, [&](const double value) {
      return solver.pressure_at(value);
    });
    flow.current  = where_it_leaks(flow, fields.current, [&](const double value) {
      return rate * value;
    });
  }
} // namespace strait::python
