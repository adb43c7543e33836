// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/text.h>
#include <strait/percolation/percolating_gap.h>
#include <strait/seal/flow_stage.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
    // The lower bound divides by the conductivity, which is therefore taken to be no
    // smaller than this share of the narrowest point's, in contact as well: that lets
    // the bound leak a little, by about this share times width over length.
    constexpr double       floor_share    = 1e-8;
    constexpr unsigned int n_paths_wanted = 3;

    // On the way to another gap, where the channel may be about to close, no mesh is
    // refined beyond this.
    constexpr unsigned long long most_on_the_way = 10000;

    // A mesh that is fine around a throat serves until the narrowest point is elsewhere
    // and this many times narrower.
    constexpr double outdone = 2.;

    // A bracket is sought on a new mesh if the leak rate is this many times what it was
    // when the mesh was made, or less by as much.
    constexpr double another_gap = 2.;

    /** Show how far the bracket of the leak rate is, as progress. */
    void
    report_flow(const FlowResult &flow, Log &log)
    {
      log.progress(format("  flow: mesh %u, %llu cells, leak rate between %.4g and %.4g",
                          flow.refinements + 1,
                          flow.cells,
                          flow.lower,
                          flow.upper));
    }

    /** Collective. */
    double
    value_at(const SlabField &field, const GridPoint &point)
    {
      const SlabLayout &layout = field.layout();
      const int         row    = point.iy % field.grid().ny - layout.first_row();
      const bool        is_own = row >= 0 && row < layout.n_rows();
      return sum(layout.communicator(),
                 is_own ? field(point.ix % field.grid().nx, row) : 0.);
    }
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
  {
    if (!parameters.mesh_file.empty())
      read_mesh(layout);
  }

  void
  FlowStage::read_mesh(const SlabLayoutPtr &layout)
  {
    constexpr double    shape_accuracy = 1e-4;
    const PeriodicGrid &grid           = layout->grid();
    seal                               = std::make_unique<const SealMesh>(
      read_seal_mesh(parameters.mesh_file, grid, layout->communicator()));
    flow_domain = FlowDomain(std::make_shared<const FlowRegion>(
      grid, seal->outline(.25 * std::min(grid.dx(), grid.dy())), layout->communicator()));

    FluidParameters fluid = parameters;
    fluid.element_degree  = 2; // where the solution is smooth
    fluid.target_accuracy = std::min(fluid.target_accuracy, shape_accuracy);
    fluid.refinement      = Refinement::adaptive;
    fluid.inlet_pressure  = 1.;
    fluid.outlet_pressure = 0.;
    GapField uniform(layout, fluid);
    uniform.update(SlabField(layout, 1.), floor_share * uniform.conductivity_of(1.));
    const FlowResult flow = ReynoldsSolver(fluid, uniform, {}, seal.get()).run();
    shape_factor          = flow.leak_rate / uniform.conductivity_of(1.);
    if (!flow.reason.empty())
      log.warn(
        format("effective gaps are uncertain, as the shape of the mesh is known to "
               "%.2g %% only because %s",
               50. * flow.relative_width(),
               flow.reason.c_str()));
    log.line(format("mesh %s: %s of %zu cells, shape factor %.5g",
                    parameters.mesh_file.c_str(),
                    seal->is_ring ? "a ring" : "a strip",
                    seal->cells.size(),
                    shape_factor));
  }

  StepFlow
  FlowStage::solve(const SlabField &gap, const double slip_length, const double share)
  {
    StepFlow        flow;
    const SlabField seen = seen_gap(gap, slip_length);
    const SlabField open = find_channel(flow, seen);
    if (!open.empty())
      mesh_and_bracket(flow, seen, open, share);
    return flow;
  }

  void
  FlowStage::mesh_and_bracket(StepFlow                &flow,
                              const SlabField         &seen,
                              const SlabField         &open,
                              const double             share,
                              const unsigned long long most_unknowns)
  {
    find_paths(flow, open);
    update_bridge(open, flow.paths.front(), true);
    make_mesh(flow);
    bracket(flow, seen, share, most_unknowns);
    meshed_leak_rate = flow.result.upper;
  }

  void
  FlowStage::follow(StepFlow        &flow,
                    const SlabField &gap,
                    const double     slip_length,
                    const double     share)
  {
    const SlabField seen = seen_gap(gap, slip_length);
    const SlabField open = find_channel(flow, seen);
    if (open.empty())
      {
        flow.paths.clear();
        flow.constrictions.reset();
        flow.result = FlowResult();
        flow.solver.reset();
        return;
      }
    std::vector<FlowPath> paths;
    if (flow.solver)
      paths = find_flow_paths(open, flow_domain, 1);
    if (paths.empty() ||
        value_at(open, meshed_bottleneck) >= outdone * paths.front().bottleneck_gap)
      {
        // Refined as for a bracket: on the first mesh the pressure is too coarse.
        mesh_and_bracket(flow, seen, open, share, most_on_the_way);
        return;
      }
    flow.paths = std::move(paths);
    update_bridge(open, flow.paths.front(), false);
    const auto scope  = timers.scope("mesh and solver");
    flow.result.upper = flow.solver->solve_pressure();
  }

  void
  FlowStage::certify(StepFlow        &flow,
                     const SlabField &gap,
                     const double     slip_length,
                     const double     share)
  {
    const SlabField seen = seen_gap(gap, slip_length);
    const SlabField open = find_channel(flow, seen);
    // Cells that are small where a very different gap was narrow are a burden here.
    const double change = flow.result.upper / meshed_leak_rate;
    if (std::max(change, 1. / change) > another_gap)
      mesh_and_bracket(flow, seen, open, share);
    else
      {
        update_bridge(open, flow.paths.front(), true);
        bracket(flow, seen, share);
      }
  }

  SlabField
  FlowStage::find_channel(StepFlow &flow, const SlabField &seen) const
  {
    flow.seal         = seal.get();
    flow.shape_factor = shape_factor;
    flow.clusters     = find_clusters(seen, flow_domain);
    if (!flow.clusters.percolates || !has_drive())
      return {};
    return percolating_gap(seen, flow.clusters, flow_domain);
  }

  void
  FlowStage::find_paths(StepFlow &flow, const SlabField &open)
  {
    const auto scope  = timers.scope("paths");
    flow.paths        = find_flow_paths(open, flow_domain, n_paths_wanted);
    meshed_bottleneck = flow.paths.front().bottleneck;
  }

  void
  FlowStage::make_mesh(StepFlow &flow)
  {
    const auto scope = timers.scope("mesh and solver");
    flow.solver.reset();
    flow.solver =
      std::make_unique<ReynoldsSolver>(parameters, gap_field, flow.paths, seal.get());
  }

  void
  FlowStage::update_bridge(const SlabField &open,
                           const FlowPath  &path,
                           const bool       with_bounds)
  {
    const auto scope = timers.scope("bridge");
    gap_field.update(open,
                     with_bounds
                       ? floor_share * gap_field.conductivity_of(path.bottleneck_gap)
                       : 0.);
  }

  void
  FlowStage::bracket(StepFlow                &flow,
                     const SlabField         &seen,
                     const double             share,
                     const unsigned long long most_unknowns)
  {
    const auto scope = timers.scope("mesh and solver");
    flow.result =
      flow.solver->run([this](const FlowResult &now) { report_flow(now, log); },
                       share,
                       most_unknowns);
    if (watches_constrictions)
      flow.constrictions = report_constrictions(seen, flow.paths.front(), *flow.solver);
  }

  void
  FlowStage::warn_of_width(const FlowResult &result)
  {
    if (!result.reason.empty())
      log.warn(format("the leak rate is known to %.1f %% only because %s",
                      50. * result.relative_width(),
                      result.reason.c_str()));
  }

  void
  FlowStage::set_inlet_pressure(const double pressure)
  {
    parameters.inlet_pressure = pressure;
  }

  SlabField
  FlowStage::seen_gap(const SlabField &gap, const double slip_length)
  {
    SlabField seen = gap;
    for (double &value : seen)
      value += 2. * slip_length;
    return seen;
  }
} // namespace strait
