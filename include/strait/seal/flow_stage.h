// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_flow_stage_h
#define strait_seal_flow_stage_h

#include <strait/base/fluid_parameters.h>
#include <strait/base/log.h>
#include <strait/base/timers.h>
#include <strait/interface/gap_field.h>
#include <strait/seal/step_flow.h>

#include <memory>

namespace strait
{
  /** From a gap to what the fluid does in it: percolation, paths, mesh, flow. */
  class FlowStage
  {
  public:
    /** @p log and @p timers must outlive this object. */
    FlowStage(const FluidParameters &fluid,
              const SlabLayoutPtr   &layout,
              Log                   &log,
              Timers                &timers);

    /** From now on, solve() and certify() look at the constrictions as well. */
    void
    watch_constrictions()
    {
      watches_constrictions = true;
    }

    /** All about one gap, the bracket of the leak rate included, to @p tolerance_factor
     *  times the target accuracy if possible. Collective. */
    StepFlow
    solve(const SlabField &gap, double slip_length, double tolerance_factor = 1.);

    /** The same in a channel that is known, with a path if anything drives a flow. */
    StepFlow solve(Channel channel, double tolerance_factor = 1.);

    /**
     * Bring @p flow, which may be new, up to date with a gap that differs a little
     * from its own: verdict, pressure, and the upper bound of the leak rate, on the
     * mesh that it has. Where the channel has opened or moved away from that mesh there
     * is a new one, for @p tolerance_factor times the target accuracy. Collective.
     */
    void follow(StepFlow        &flow,
                const SlabField &gap,
                double           slip_length,
                double           tolerance_factor);

    /**
     * Complete what follow() left out, the bracket of the leak rate, on the same mesh
     * or finer ones, or on a new one if the leak rate is quite another than when that was
     * made, to @p tolerance_factor times the target accuracy if possible. Collective.
     */
    void certify(StepFlow &flow, double tolerance_factor);

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
    void set_inlet_pressure(double pressure);

    /** Whether reservoirs differ in pressure. */
    bool
    has_drive() const
    {
      return parameters.inlet_pressure != parameters.outlet_pressure;
    }

  private:
    void    read_mesh(const SlabLayoutPtr &layout);
    Channel find_channel(const SlabField &gap, double slip_length);
    void    update_bridge(const Channel &channel, bool with_bounds);
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
    double meshed_leak_rate      = 0.;                 // likewise; 0: it was discarded
    bool   watches_constrictions = false;
  };
} // namespace strait

#endif
