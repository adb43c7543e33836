// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/iteration.h>
#include <strait/base/text.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/seal/flow_stage.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    // Floor of the conductivity, in contact as well, as a fraction of that at the
    // narrowest point, because the lower bound divides by the conductivity. It lets the
    // bound leak a little, by about this fraction times width over length. Half and
    // double of it change the leak rate by less than that.
    constexpr double floor_fraction = 1e-8;

    // Unknowns beyond which no mesh is refined on the way to another gap, where the
    // channel may be about to close. Half of it makes the fluid's pressure on the wall
    // coarser, which takes more rounds on finer meshes; double of it spends more on
    // states that are left again.
    constexpr unsigned long long most_unknowns_while_following = 10000;
  } // namespace

  FlowStage::FlowStage(const FluidParameters &fluid,
                       const SlabLayoutPtr   &layout,
                       Log                   &log_,
                       Timers                &timers_)
    : parameters(fluid)
    , log(log_)
    , timers(timers_)
    , gap_field(layout, fluid)
    , flow_domain(parameters.direction)
    , aspect(parameters.direction == FlowDirection::x
               ? layout->grid().lx / layout->grid().ly
               : layout->grid().ly / layout->grid().lx)
  {
    if (!parameters.mesh_file.empty())
      read_mesh(layout);
  }

  void
  FlowStage::read_mesh(const SlabLayoutPtr &layout)
  {
    const PeriodicGrid &grid = layout->grid();
    seal                     = std::make_shared<const SealMesh>(
      read_seal_mesh(parameters.mesh_file, grid, layout->communicator()));
    flow_domain = FlowDomain(std::make_shared<const FlowRegion>(
      grid, seal->outline(.25 * std::min(grid.dx(), grid.dy())), layout->communicator()));

    // Find the shape factor. No bracket is written for it, and effective gaps inherit a
    // third of its error.
    FluidParameters fluid = parameters;
    fluid.element_degree  = 2; // the solution is smooth
    fluid.target_accuracy *= intermediate_tolerance_factor;
    fluid.uniform_refinement = false;
    fluid.inlet_pressure     = 1.;
    fluid.outlet_pressure    = 0.;
    GapField uniform(layout, fluid);
    uniform.update(SlabField(layout, 1.), floor_fraction * uniform.conductivity_of(1.));
    const Leakage leakage      = ReynoldsSolver(fluid, uniform, seal.get()).run({});
    const double  shape_factor = leakage.rate / uniform.conductivity_of(1.);
    aspect                     = 1. / shape_factor;
    if (!leakage.reason.empty())
      log.warn(
        format("effective gaps are uncertain, as the shape of the mesh is known to "
               "%.2g %% only because %s",
               100. * leakage.relative_error(),
               leakage.reason.c_str()));
    log.line(format("mesh %s: %s of %zu cells, shape factor %.5g",
                    parameters.mesh_file.c_str(),
                    seal->is_ring ? "a ring" : "a strip",
                    seal->cells.size(),
                    shape_factor));
  }

  StepFlow
  FlowStage::solve(const SlabField &gap,
                   const double     slip_length,
                   const double     tolerance_factor)
  {
    StepFlow flow;
    flow.seal    = seal.get();
    flow.channel = find_channel(gap, slip_length);
    if (!flow.channel.paths.empty())
      mesh_and_bracket(flow, tolerance_factor, ReynoldsSolver::unlimited);
    return flow;
  }

  double
  FlowStage::change_by_interpolation(const StepFlow &flow) const
  {
    FluidParameters other = parameters;
    other.interpolation   = parameters.interpolation == GapInterpolation::monotone_cubic
                              ? GapInterpolation::bilinear
                              : GapInterpolation::monotone_cubic;
    GapField bridge(flow.channel.gap.layout_pointer(), other);
    return change_through(flow, other, flow.channel, bridge);
  }

  double
  FlowStage::change_to(const SlabField &gap,
                       const double     slip_length,
                       const StepFlow  &flow)
  {
    const Channel channel = find_channel(gap, slip_length);
    return channel.paths.empty() ? -1.
                                 : change_through(flow, parameters, channel, gap_field);
  }

  double
  FlowStage::change_through(const StepFlow        &flow,
                            const FluidParameters &fluid,
                            const Channel         &channel,
                            GapField              &bridge) const
  {
    fill(bridge, channel, true);
    const double change = flow.solution->change_in(bridge);
    if (std::abs(change) <= parameters.target_accuracy)
      return change;
    // The mesh was made for another gap: in this one, a few coarse cells may let more
    // through than the throat does.
    return ReynoldsSolver(fluid, bridge, seal.get()).run(channel).rate /
             flow.leakage.rate -
           1.;
  }

  bool
  FlowStage::find_channel(StepFlow &flow, const SlabField &gap, const double slip_length)
  {
    flow.seal    = seal.get();
    flow.channel = find_channel(gap, slip_length);
    flow.leakage = Leakage();
    flow.solution.reset();
    return flow.channel.percolates();
  }

  void
  FlowStage::follow(StepFlow &flow, const double tolerance_factor)
  {
    const Channel &channel = flow.channel;
    if (channel.paths.empty())
      return;
    const auto is_still_narrow = [&]() {
      const GridPoint  &at     = meshed_bottleneck;
      const SlabLayout &layout = channel.gap.layout();
      const double      there  = at.window < 0
                                   ? fetch_rows(channel.gap, {at.iy})[at.ix % layout.grid().nx]
                                   : channel.gap[layout.index_of(at)];
      return there > 0. && there < remesh_ratio * channel.paths.front().bottleneck_gap;
    };
    if (!flow.followed || !is_still_narrow())
      {
        // Refine as for a bracket: on the first mesh the pressure is too coarse.
        mesh_and_bracket(flow, tolerance_factor, most_unknowns_while_following);
        return;
      }
    flow.solution = flow.followed;
    fill(gap_field, channel, false);
    const auto scope   = timers.scope("mesh and solver");
    flow.leakage.upper = flow.solution->solve_pressure();
  }

  const Leakage &
  FlowStage::certify(StepFlow &flow, const double tolerance_factor)
  {
    // Cells refined for the throat of a very different gap are a burden here.
    const double change = flow.leakage.upper / meshed_leak_rate;
    if (std::max(change, 1. / change) > remesh_ratio)
      mesh_and_bracket(flow, tolerance_factor, ReynoldsSolver::unlimited);
    else
      {
        fill(gap_field, flow.channel, true);
        bracket(flow, tolerance_factor, ReynoldsSolver::unlimited);
      }
    return flow.leakage;
  }

  /** The channel of @p gap, with a path only if the reservoirs differ in pressure. */
  Channel
  FlowStage::find_channel(const SlabField &gap, const double slip_length)
  {
    const auto scope         = timers.scope("channel");
    const bool has_drive     = parameters.inlet_pressure != parameters.outlet_pressure;
    const bool tells_trapped = parameters.feedback.keeps_trapped_fluid();
    return make_channel(gap, slip_length, flow_domain, has_drive ? 1 : 0, tells_trapped);
  }

  void
  FlowStage::mesh_and_bracket(StepFlow                &flow,
                              const double             tolerance_factor,
                              const unsigned long long most_unknowns)
  {
    fill(gap_field, flow.channel, true);
    {
      const auto scope = timers.scope("mesh and solver");
      flow.followed.reset();
      flow.solution.reset();
      flow.solution = flow.followed =
        std::make_shared<ReynoldsSolver>(parameters, gap_field, seal.get());
    }
    bracket(flow, tolerance_factor, most_unknowns);
    meshed_bottleneck = flow.channel.paths.front().bottleneck;
    meshed_leak_rate  = flow.leakage.upper;
  }

  void
  FlowStage::fill(GapField &bridge, const Channel &channel, const bool with_bounds) const
  {
    const auto scope = timers.scope("bridge");
    bridge.take_gas(make_rarefied_flow(parameters, channel.paths.front()));
    const double narrowest = bridge.conductivity_of(channel.paths.front().bottleneck_gap);
    bridge.update(channel.gap, with_bounds ? floor_fraction * narrowest : 0.);
  }

  void
  FlowStage::bracket(StepFlow                &flow,
                     const double             tolerance_factor,
                     const unsigned long long most_unknowns)
  {
    const auto scope = timers.scope("mesh and solver");
    flow.leakage     = flow.solution->run(
      flow.channel,
      [this](const Leakage &now) {
        log.progress(
          format("  flow: mesh %u, %llu cells, leak rate between %.4g and %.4g",
                 now.refinements + 1,
                 now.cells,
                 now.lower,
                 now.upper));
      },
      tolerance_factor,
      most_unknowns);
    flow.leakage.aspect = aspect;
  }

  void
  FlowStage::warn_of_width(const Leakage &leakage)
  {
    if (!leakage.reason.empty())
      log.warn(format("the leak rate is known to %.3g %% only because %s",
                      100. * leakage.relative_error(),
                      leakage.reason.c_str()));
  }
} // namespace strait
