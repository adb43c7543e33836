// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_fluid_on_wall_h
#define strait_seal_fluid_on_wall_h

#include <strait/base/scene.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/harmonic_extension.h>
#include <strait/seal/pools_in_gap.h>
#include <strait/seal/seal_state.h>
#include <strait/seal/unsettled_pools.h>

#include <optional>

namespace strait
{
  /**
   * The pressure of the fluid on the walls of a given gap: that of the flow in the
   * channel, that of the reservoir in regions that only one of them reaches, harmonic
   * under the contact, and in trapped fluid what its law says.
   *
   * A pool of trapped fluid takes the pressure at which it would hold its mass if it
   * widened by its compliance; what it widens by in truth shows in the next gap. So its
   * pressure is found together with that of all other fluid. What has just been cut off
   * keeps the pressure that it has.
   */
  class FluidOnWall
  {
  public:
    /** On the way to the state under @p control from the state @p from, or without a past
     *  if that is null. All of them must outlive this object. */
    FluidOnWall(const Scene       &scene,
                const Control     &control,
                const FlowStage   &flow,
                HarmonicExtension &extension,
                std::size_t        n_local_points,
                const SealState   *from);

    /** The pressure in the gap of @p contact, where the flow is @p fluid_flow, after
     *  @p assumed has made that gap. Collective. */
    SlabField pressure(const ContactState &contact,
                       const StepFlow     &fluid_flow,
                       const SlabField    &assumed);

    /**
     * Once contact and flow agree on @p pressure: find out which pools there are now.
     * Returns whether pools met a reservoir or each other, so that the pressure is
     * another one. Collective.
     */
    bool settle(const ContactState &contact,
                const StepFlow     &fluid_flow,
                const SlabField    &pressure);

    /** What settle() has found, or what was known before; none if it is drained. */
    const std::optional<TrappedFluid> &
    trapped() const
    {
      return found;
    }

    /** Whether the fluid cannot carry more than the load: adhesion could hold against it.
     */
    bool is_limited_by_load() const;

  private:
    PoolsInGap pools_in(const SlabField &open_gap, const StepFlow &fluid_flow) const;
    void       assign(SlabField        &pressure,
                      SlabField        &open_gap,
                      const StepFlow   &fluid_flow,
                      const PoolsInGap *pools) const;
    double     hold(SlabField          &pressure,
                    SlabField          &open_gap,
                    const ContactState &contact,
                    const SlabField    &assumed,
                    const PoolsInGap   &pools) const;

    const Scene                &scene;
    const Control               control;
    const FlowStage            &flow;
    HarmonicExtension          &extension;
    TrappedFluid                known; // at the start of the step, or when pools last met
    std::optional<TrappedFluid> found;
    UnsettledPools              unsettled;        // of fluid that is drained
    const SealState            *past;             // none at the first state of a path
    double                      uncertainty = 0.; // of what was cut off and is known now
    bool                        has_extended; // so that the assumed pressure is a start
  };
} // namespace strait

#endif
