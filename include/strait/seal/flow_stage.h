// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>
#include <strait/base/log.h>
#include <strait/base/timers.h>
#include <strait/flow/leakage.h>
#include <strait/interface/gap_field.h>
#include <strait/percolation/channel.h>

#include <memory>
#include <optional>

namespace strait
{
  class ReynoldsSolver;
  struct SealMesh;

  /** What the fluid does in one gap. */
  struct StepFlow
  {
    Channel channel;
    Leakage leakage; // a rate of zero where nothing percolates

    /** If the scene looks for the threshold and something percolates. */
    std::optional<ConstrictionReport> constrictions;

    /** For fields and pictures: the mesh that the scene names, null if the fluid flows in
     *  the box, and the mesh and pressure of the flow, null where nothing percolates;
     *  valid until the flow stage is given another gap. */
    const SealMesh                 *seal = nullptr;
    std::shared_ptr<ReynoldsSolver> solution;

    /** The last solution, whose mesh follow() goes on with where a channel opens again.
     */
    std::shared_ptr<ReynoldsSolver> followed;
  };

  /** From a gap to what the fluid does in it: percolation, paths, mesh, flow. */
  class FlowStage
  {
  public:
    /**
     * A mesh that is fine around a throat serves, should that close and open again as
     * well, until no channel leads there or one is this many times narrower elsewhere;
     * and for a bracket until the leak rate is as many times what it was when the mesh
     * was made, or less by as much. Half of it makes a new mesh each time. Double of it
     * takes the pressure around a new throat from cells that are too coarse for it, and
     * keeps more cells that no longer matter.
     */
    static constexpr double another_gap = 2.;

    /** @p log and @p timers must outlive this object. */
    FlowStage(const FluidParameters &fluid,
              const SlabLayoutPtr   &layout,
              Log                   &log,
              Timers                &timers);

    /** All about one gap, the bracket of the leak rate included, to @p tolerance_factor
     *  times the target accuracy if possible. Collective. */
    StepFlow
    solve(const SlabField &gap, double slip_length, double tolerance_factor = 1.);

    /** By how much the leak rate of @p flow, which solve() has found and which is not
     * zero, would change, relative, if the gap between the points were interpolated the
     * other way. Collective. */
    double change_by_interpolation(const StepFlow &flow) const;

    /** By how much, relative, the leak rate through @p gap differs from that of @p flow,
     * which is not zero and which a stage for the same box has found, whose grid has as
     * many points each way or 2, 4 … times as many; −1 if the gap seals. Collective. */
    double change_to(const SlabField &gap, double slip_length, const StepFlow &flow);

    /** Bring @p flow, which may be new, into another gap, where nothing is known of it
     *  yet but whether a channel percolates, which is returned. Collective. */
    bool find_channel(StepFlow &flow, const SlabField &gap, double slip_length);

    /**
     * Find the flow through that channel, in a gap that differs a little from the one
     * before: its pressure, and the upper bound of the leak rate, on the mesh that it
     * has. Where the channel has opened or moved away from that mesh there is a new one,
     * for @p tolerance_factor times the target accuracy. Collective.
     */
    void follow(StepFlow &flow, double tolerance_factor);

    /**
     * Complete what follow() left out, the bracket of the leak rate, on the same mesh
     * or finer ones, or on a new one if the leak rate is quite another than when that was
     * made, to @p tolerance_factor times the target accuracy if possible. Returns the
     * leakage. Collective.
     */
    const Leakage &certify(StepFlow &flow, double tolerance_factor);

    /** Let the next certify() make a new mesh in any case. */
    void
    discard_mesh()
    {
      meshed_leak_rate = 0.;
    }

    /** Give back the memory of the bridge; flows that were solved cannot be refined. */
    void
    release()
    {
      gap_field.release();
    }

    /** Say how well a leak rate is known, and why no better, if there is a reason. */
    void warn_of_width(const Leakage &leakage);

    /** Where the fluid flows. */
    const FlowDomain &
    domain() const
    {
      return flow_domain;
    }

    const FluidParameters &
    fluid() const
    {
      return parameters;
    }

    /** For flows that are solved from now on [pressure]. */
    void
    set_inlet_pressure(const double pressure)
    {
      parameters.inlet_pressure = pressure;
    }

  private:
    void    read_mesh(const SlabLayoutPtr &layout);
    Channel find_channel(const SlabField &gap, double slip_length);
    void    fill(GapField &bridge, const Channel &channel, bool with_bounds) const;
    double  change_through(const StepFlow        &flow,
                           const FluidParameters &fluid,
                           const Channel         &channel,
                           GapField              &bridge) const;
    void    mesh_and_bracket(StepFlow          &flow,
                             double             tolerance_factor,
                             unsigned long long most_unknowns);
    void
    bracket(StepFlow &flow, double tolerance_factor, unsigned long long most_unknowns);

    FluidParameters                 parameters;
    Log                            &log;
    Timers                         &timers;
    GapField                        gap_field;
    std::shared_ptr<const SealMesh> seal; // null: the box
    FlowDomain                      flow_domain;
    double                          aspect;            // of the domain, see Leakage
    GridPoint                       meshed_bottleneck; // that the last mesh was made for
    double meshed_leak_rate = 0.;                      // likewise; 0: it was discarded
  };
} // namespace strait
