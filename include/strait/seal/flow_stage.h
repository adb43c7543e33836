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

  /** The flow through one gap. */
  struct StepFlow
  {
    Channel channel;
    Leakage leakage; // rate 0 where nothing percolates

    /** Set if the scene looks for the threshold and something percolates. */
    std::optional<ConstrictionReport> constrictions;

    /** For fields and pictures. `seal` is the seal mesh that the scene names, null if the
     *  fluid flows in the box; `solution` has the mesh and the pressure of the flow, null
     *  where nothing flows. Valid until the flow stage is given another gap. */
    const SealMesh                 *seal = nullptr;
    std::shared_ptr<ReynoldsSolver> solution;

    /** The last solution; follow() continues on its mesh where a channel opens again. */
    std::shared_ptr<ReynoldsSolver> followed;
  };

  /** Finds the flow through a gap: percolation, paths, mesh, solution. */
  class FlowStage
  {
  public:
    /**
     * How far a gap may differ from the one for which a mesh was made. follow() keeps a
     * mesh, even if its throat closes and opens again, as long as the channel leads
     * through that throat and is nowhere narrower by this factor or more. certify() keeps
     * it as long as the leak rate differs by at most this factor. Half of it makes a new
     * mesh each time. Double of it takes the pressure around a new throat from cells that
     * are too coarse for it, and keeps more cells that no longer matter.
     */
    static constexpr double remesh_ratio = 2.;

    /** @p log and @p timers must outlive this object. */
    FlowStage(const FluidParameters &fluid,
              const SlabLayoutPtr   &layout,
              Log                   &log,
              Timers                &timers);

    /** Find the channel, the flow and the bracket of the leak rate in @p gap, to
     *  @p tolerance_factor times the target accuracy if possible. Collective. */
    StepFlow
    solve(const SlabField &gap, double slip_length, double tolerance_factor = 1.);

    /** Return the relative change of the leak rate if the gap between the points were
     *  interpolated the other way. @p flow comes from solve(), and its leak rate is not
     *  zero. Collective. */
    double change_by_interpolation(const StepFlow &flow) const;

    /** Return the relative difference of the leak rate through @p gap from that of
     *  @p flow, which is not zero; −1 if the gap seals. A stage for the same box has
     *  found the flow, on a grid of as many points each way, or 2, 4, … times as many.
     *  Collective. */
    double change_to(const SlabField &gap, double slip_length, const StepFlow &flow);

    /** Begin with another gap: find its channel and reset the rest of @p flow, which may
     *  be new. Returns whether a channel percolates. Collective. */
    bool find_channel(StepFlow &flow, const SlabField &gap, double slip_length);

    /**
     * Find the pressure, and the upper bound of the leak rate, in the channel of
     * find_channel(), on the mesh of the gap before, from which this one differs a
     * little. If there is no mesh yet, or the channel has left its fine cells, make a new
     * one, for @p tolerance_factor times the target accuracy. Collective.
     */
    void follow(StepFlow &flow, double tolerance_factor);

    /**
     * Find what follow() leaves out, the bracket of the leak rate, to @p tolerance_factor
     * times the target accuracy if possible: on the same mesh or finer ones, or on a new
     * one if the leak rate is quite another than when the mesh was made. Returns the
     * leakage. Collective.
     */
    const Leakage &certify(StepFlow &flow, double tolerance_factor);

    /** Make the next certify() begin with a new mesh. */
    void
    discard_mesh()
    {
      meshed_leak_rate = 0.;
    }

    /** Release the memory of the gap field; solved flows cannot be refined any more. */
    void
    release()
    {
      gap_field.release();
    }

    /** Warn of a leak rate that misses its target accuracy, with the reason. */
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

    /** Set the inlet pressure of flows that are solved from now on [pressure]. */
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
    std::shared_ptr<const SealMesh> seal; // null: flow in the box
    FlowDomain                      flow_domain;
    double                          aspect;            // of the domain, see Leakage
    GridPoint                       meshed_bottleneck; // for which the last mesh was made
    double meshed_leak_rate = 0.;                      // likewise; 0: it was discarded
  };
} // namespace strait
