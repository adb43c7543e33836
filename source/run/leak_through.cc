// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/load_sweep.h>
#include <strait/seal/seal_models.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    // Share of the target accuracy for the mesh, with zoom, where the target is for all
    // errors together. Half of it makes twice the cells, double of it leaves nothing for
    // the gap.
    constexpr double fraction_of_mesh = .5;

    /** Return the flow between walls that have lifted off: nothing limits the leak. */
    StepFlow
    unlimited_flow(const std::size_t n_points, const FluidParameters &fluid)
    {
      StepFlow flow;
      flow.channel.clusters.percolates = true;
      flow.channel.clusters.states.assign(n_points, NodeState::percolating);
      flow.leakage.upper = std::numeric_limits<double>::infinity();
      flow.leakage.rate =
        std::copysign(flow.leakage.upper, fluid.inlet_pressure - fluid.outlet_pressure);
      return flow;
    }

    /** Return the share of the target accuracy that the bracket of the leak rate in
     *  @p state may take, after that of the fluid's pressure on the wall. */
    double
    fraction_of_bracket(const SealState &state, const double target_accuracy)
    {
      return state.fluid ? std::max(mesh_fraction,
                                    1. - 2. * state.fluid->mesh_error / target_accuracy)
                         : 1.;
    }

    /** Widen the bracket in @p result, because the pressure of @p fluid on the wall
     *  leaves the gap uncertain. */
    void
    allow_for_feedback(Leakage          &result,
                       const FluidState &fluid,
                       const double      target_accuracy)
    {
      result.lower *= std::max(0., 1. - fluid.mesh_error);
      result.upper *= 1. + fluid.mesh_error;
      if (result.status == "ok" && result.relative_width() > target_accuracy)
        {
          result.status = "flow-accuracy";
          result.reason = "the fluid's pressure on the wall leaves the gap uncertain";
        }
    }
  } // namespace

  StepFlow
  leak_through(const SealState &state, const Scene &scene, FlowStage &flow)
  {
    const double accuracy = scene.fluid.target_accuracy;
    StepFlow     result =
      state.fluid && state.fluid->lifted_off
            ? unlimited_flow(state.gap().size(), scene.fluid)
            : flow.solve(state.gap(),
                     state.control.slip_length,
                     fraction_of_bracket(state, accuracy) *
                       (scene.contact.zoom.enabled ? fraction_of_mesh : 1.));
    if (state.fluid && result.solution)
      allow_for_feedback(result.leakage, *state.fluid, accuracy);
    flow.warn_of_width(result.leakage);
    return result;
  }

  SlabField
  two_in_a_row(const SlabField &gap)
  {
    const int    nx   = gap.grid().nx;
    PeriodicGrid grid = gap.grid();
    grid.nx *= 2;
    grid.lx *= 2.;
    // Rows are distributed by their number alone, so each rank doubles its own rows.
    SlabField two(make_layout(grid, gap.layout().communicator()));
    for (int row = 0; row < gap.layout().n_rows(); ++row)
      for (const int half : {0, 1})
        std::copy_n(&gap.data()[static_cast<std::size_t>(row) * nx],
                    nx,
                    &two(half * nx, row));
    return two;
  }
} // namespace strait
