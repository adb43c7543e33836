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
   * Regions of drained fluid that have no state at the pool pressure: once such a region
   * is dry, the channel's fluid comes in, and once that is in, the region is cut off
   * again. A point that is trapped for a second time therefore does not count as trapped,
   * but as what it was in between: part of the region that it was joined to, or contact.
   */
  class UnsettledRegions
  {
  public:
    /** Record the states of the next round, one per local grid point. */
    void note(const std::vector<NodeState> &now);

    /** The last state other than trapped of local grid point @p k, if it lies in such a
     *  region; otherwise nothing. */
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
      bool      has_ceased = false; // to be trapped, once before
    };

    std::vector<Point> points;
  };

  /**
   * Compute the harmonic extension under the contact of a fluid pressure that is known at
   * the open grid points: solve Laplace's equation there (five-point stencil), with the
   * pressure at the open points around it and at the reservoirs as boundary values. It
   * obeys the maximum principle, and a uniform pressure stays uniform.
   *
   * A point that is about to open must not change the result abruptly, or the coupled
   * iteration oscillates with it. Points at the contact line, whose gap is less than half
   * of the largest beside them, are therefore tied to the fluid by a spring:
   * −∇²p + κ (p − p_f) = 0, where κ rises from 0 at a vanishing gap to infinity where the
   * point counts as open.
   *
   * The solver is conjugate gradients, preconditioned by symmetric successive
   * over-relaxation within the rows of each rank.
   *
   * @p flow_gap: 0 under the contact; minus the gap where the pressure is known, whatever
   * the gaps beside it are, as at the widest points of trapped fluid. @p pressure: on
   * entry, that of the fluid where @p flow_gap is not 0 and an initial guess elsewhere;
   * on return, the extended pressure everywhere, to 1e-7 of the boundary values. On the
   * seam, which is inlet and outlet at once, every point gets the mean of the two
   * reservoirs, because sums over the grid are a trapezoidal rule. Windows are solved one
   * level after the other, each between the values of its parent around it.
   * Returns the number of iterations. Collective.
   */
  int extend_under_contact(SlabField       &pressure,
                           const SlabField &flow_gap,
                           FlowDirection    direction,
                           double           inlet_pressure,
                           double           outlet_pressure);

  /**
   * The pressure of the fluid on the walls of a given gap. In the channel it is that of
   * the flow; in regions that only one reservoir reaches, that of the reservoir; under
   * the contact, the harmonic extension; and in trapped fluid it follows the law of the
   * scene, which is `Pool pressure` where it is drained (but see UnsettledRegions).
   *
   * A region of trapped fluid takes the pressure at which it would hold its mass if it
   * widened by its estimated compliance; by how much it really widens shows in the next
   * gap. Its pressure is thus found together with that of all other fluid. Fluid that has
   * just been cut off keeps its pressure.
   */
  class FluidOnWall
  {
  public:
    /** Fraction of the load that the fluid may carry while the solid surely carries the
     *  rest; only beyond it can a round lift the walls off. With half of the rest, walls
     *  part a round later; with double of it, walls may part that the rest would have
     *  held close to each other. */
    static constexpr double largest_fraction = .99;

    /** For the state under @p control that is reached from the state @p from, or without
     *  a past if that is null. @p scene and @p from must outlive this object. */
    FluidOnWall(const Scene &scene, const Control &control, const SealState *from);

    /** Return the pressure in the gap of @p contact, which was found under the pressure
     *  @p assumed and in which the flow is @p fluid_flow. Collective. */
    SlabField pressure(const ContactState &contact,
                       const StepFlow     &fluid_flow,
                       const SlabField    &assumed);

    /**
     * Find the regions of trapped fluid anew, once contact and flow agree on @p pressure.
     * Returns whether regions met a reservoir or each other, so that the pressure must be
     * found again. Collective.
     */
    bool settle(const ContactState &contact,
                const StepFlow     &fluid_flow,
                const SlabField    &pressure);

    /** The trapped fluid found by settle(), or that of before; none if it is drained. */
    const std::optional<TrappedFluid> &
    trapped() const
    {
      return found;
    }

    /** Whether the fluid cannot carry more than the load, as it could against adhesion or
     *  at a prescribed mean gap. */
    bool is_limited_by_load() const;

  private:
    void assign(SlabField          &pressure,
                SlabField          &open_gap,
                const StepFlow     &fluid_flow,
                const RegionsInGap *regions) const;
    void set_trapped_pressures(SlabField          &pressure,
                               SlabField          &open_gap,
                               const ContactState &contact,
                               const SlabField    &assumed,
                               const RegionsInGap &regions) const;

    const Scene  &scene;
    const Control control;
    // At the start of the step, from which its uncertainty counts, or when regions last
    // met.
    TrappedFluid                known;
    std::optional<TrappedFluid> found;
    UnsettledRegions            unsettled; // of drained fluid
    const SealState            *past;      // null at the first state of a path
    bool has_initial_extension;            // the assumed pressure is a good start
  };
} // namespace strait
