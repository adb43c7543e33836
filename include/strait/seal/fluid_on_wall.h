// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/percolation/clusters.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/regions_in_gap.h>
#include <strait/seal/seal_state.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace strait
{
  /**
   * Regions of drained fluid for which there is no state with its pressure: the channel's
   * fluid comes in as soon as they are dry and is cut off once it is in. What has ceased
   * to be trapped does not count as trapped when it comes back, but as what it was in
   * between: as part of the region that it was joined to, or as contact.
   */
  class UnsettledRegions
  {
  public:
    /** Take note of the states of the next round, one per local grid point. */
    void note(const std::vector<NodeState> &now);

    /** What a local grid point in such a region last was but trapped; else nothing. */
    std::optional<NodeState>
    state_before(const std::size_t k) const
    {
      return points[k].is_trapped && points[k].has_ceased
               ? std::optional(points[k].before)
               : std::nullopt;
    }

  private:
    struct Point
    {
      NodeState before     = NodeState::closed;
      bool      is_trapped = false; // in the last round
      bool      has_ceased = false; // to be trapped
    };

    std::vector<Point> points;
  };

  /**
   * Continues a fluid pressure, known at the open grid points, smoothly under the
   * contact: there it solves Laplace's equation (five-point stencil), with the
   * pressure at the open points around it and at the reservoirs as boundary values.
   * So it obeys the maximum principle, and a uniform pressure stays uniform.
   *
   * A point that is about to open must not change the result at once, or the iteration
   * of contact and flow jumps to and fro with it. Points at the contact line, whose gap
   * is less than half of the largest beside them, are therefore tied to the fluid by a
   * spring: −∇²p + κ (p − p_f) = 0, with κ from 0 where the gap vanishes to infinity
   * where the point counts as open.
   *
   * Conjugate gradients, preconditioned by successive over-relaxation to and fro, each
   * rank by its own rows.
   *
   * @p pressure: on entry that of the fluid where @p flow_gap > 0 and a start
   * elsewhere; on return that everywhere, to 1e-7 of the boundary values. On the seam,
   * which is inlet and outlet at once, every point gets the mean of the two reservoirs,
   * as the sum over the grid is a trapezoidal rule. Where there are windows this is done
   * on one level after the other, in each window between what its parent has around it.
   * Returns the number of iterations. Collective.
   */
  int extend_under_contact(SlabField       &pressure,
                           const SlabField &flow_gap,
                           FlowDirection    direction,
                           double           inlet_pressure,
                           double           outlet_pressure);

  /**
   * The pressure of the fluid on the walls of a given gap: that of the flow in the
   * channel, that of the reservoir in regions that only one of them reaches, harmonic
   * under the contact, and in trapped fluid what its law says, which is Pool
   * pressure where it is drained (but see UnsettledRegions).
   *
   * A region of trapped fluid takes the pressure at which it would hold its mass if it
   * widened by its compliance; what it widens by in truth shows in the next gap. So its
   * pressure is found together with that of all other fluid. What has just been cut off
   * keeps the pressure that it has.
   */
  class FluidOnWall
  {
  public:
    /** Of the load: what fluid may carry without a doubt that the solid carries the rest.
     *  Half as much of a rest takes one round more before walls part, double of it may
     *  part walls that the rest would have held near each other. */
    static constexpr double largest_fraction = .99;

    /** On the way to the state under @p control from the state @p from, or without a past
     *  if that is null. All of them must outlive this object. */
    FluidOnWall(const Scene &scene, const Control &control, const SealState *from);

    /** The pressure in the gap of @p contact, where the flow is @p fluid_flow, after
     *  @p assumed has made that gap. Collective. */
    SlabField pressure(const ContactState &contact,
                       const StepFlow     &fluid_flow,
                       const SlabField    &assumed);

    /**
     * Once contact and flow agree on @p pressure: find out which regions there are now.
     * Returns whether regions met a reservoir or each other, so that the pressure is
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
    void assign(SlabField          &pressure,
                SlabField          &open_gap,
                const StepFlow     &fluid_flow,
                const RegionsInGap *regions) const;
    void hold(SlabField          &pressure,
              SlabField          &open_gap,
              const ContactState &contact,
              const SlabField    &assumed,
              const RegionsInGap &regions) const;

    const Scene  &scene;
    const Control control;
    // At the start of the step, which its uncertainty counts from, or when regions last
    // met.
    TrappedFluid                known;
    std::optional<TrappedFluid> found;
    UnsettledRegions            unsettled;    // of fluid that is drained
    const SealState            *past;         // none at the first state of a path
    bool                        has_extended; // so that the assumed pressure is a start
  };
} // namespace strait
