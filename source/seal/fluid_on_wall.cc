// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/reynolds_solver.h>
#include <strait/flow/solution_on_grid.h>
#include <strait/seal/fluid_on_wall.h>

#include <algorithm>
#include <limits>

namespace strait
{
  void
  UnsettledRegions::note(const std::vector<NodeState> &now)
  {
    points.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k)
      if (Point &point = points[k]; now[k] == NodeState::trapped)
        point.is_trapped = true;
      else
        point = {now[k], false, point.has_ceased || point.is_trapped};
  }

  FluidOnWall::FluidOnWall(const Scene     &scene_,
                           const Control   &control_,
                           const SealState *from)
    : scene(scene_)
    , control(control_)
    , past(from != nullptr && from->fluid && from->fluid->trapped ? from : nullptr)
    , has_initial_extension(from != nullptr && from->fluid)
  {
    if (!scene.fluid.feedback.keeps_trapped_fluid())
      return;
    if (past != nullptr)
      {
        known             = *past->fluid->trapped;
        known.uncertainty = 0.;
      }
    found = known;
  }

  bool
  FluidOnWall::is_limited_by_load() const
  {
    return scene.contact.is_load_controlled() && !scene.contact.adhesion.enabled;
  }

  SlabField
  FluidOnWall::pressure(const ContactState &contact,
                        const StepFlow     &fluid_flow,
                        const SlabField    &assumed)
  {
    SlabField open   = open_gap(contact.gap, control.slip_length);
    SlabField result = assumed;
    if (found)
      {
        if (known.owner.empty())
          {
            known.owner.assign(assumed.size(), TrappedFluid::reservoirs);
            found = known;
          }
        const SlabField    gap = open;
        const RegionsInGap regions(known, gap, fluid_flow.channel.clusters);
        assign(result, open, fluid_flow, &regions);
        set_trapped_pressures(result, open, contact, assumed, regions);
      }
    else
      {
        unsettled.note(fluid_flow.channel.clusters.states);
        assign(result, open, fluid_flow, nullptr);
      }
    has_initial_extension = true;
    extend_under_contact(result,
                         open,
                         scene.fluid.direction,
                         control.inlet_pressure,
                         scene.fluid.outlet_pressure);
    // A region that is too full, or fluid in front of a closed channel, may seem to lift
    // the wall off, but its pressure falls as soon as the wall gives way. Lift-off is
    // certain only once the solid carries next to nothing. Until then, leave the solid
    // half of what it carries.
    const double before = mean(assumed);
    if (is_limited_by_load() && mean(result) >= control.target &&
        before < largest_fraction * control.target)
      {
        const double part = .5 * (control.target - before) / (mean(result) - before);
        for (std::size_t k = 0; k < result.size(); ++k)
          result[k] = assumed[k] + part * (result[k] - assumed[k]);
      }
    return result;
  }

  /** Set the pressure of all fluid except that in @p regions, if they are given. Points
   *  that count as contact are closed in @p open_gap. */
  void
  FluidOnWall::assign(SlabField          &pressure,
                      SlabField          &open_gap,
                      const StepFlow     &fluid_flow,
                      const RegionsInGap *regions) const
  {
    const std::vector<NodeState> &states = fluid_flow.channel.clusters.states;
    const double    inlet = control.inlet_pressure, outlet = scene.fluid.outlet_pressure;
    const SlabField channel =
      fluid_flow.solution
        ? potential_on_grid(*fluid_flow.solution, pressure.layout_pointer())
        : SlabField();
    for (std::size_t k = 0; k < pressure.size(); ++k)
      {
        if (regions != nullptr && regions->region_of_point[k] >= 0)
          continue;
        std::optional<NodeState> before;
        if (regions == nullptr)
          before = unsettled.state_before(k);
        switch (before.value_or(states[k]))
          {
            case NodeState::percolating:
              if (before)
                break; // it keeps the pressure at which it was cut off
              pressure[k] =
                channel.empty() ? inlet : fluid_flow.solution->pressure_at(channel[k]);
              break;
            case NodeState::inlet_side:
              pressure[k] = inlet;
              break;
            case NodeState::outlet_side:
              pressure[k] = outlet;
              break;
            case NodeState::trapped:
            case NodeState::outside: // does not occur in the box
              pressure[k] = scene.fluid.feedback.pool_pressure;
              break;
            case NodeState::closed:
              if (!has_initial_extension)
                pressure[k] = .5 * (inlet + outlet);
              open_gap[k] = 0.;
              break;
          }
      }
  }

  /** Set the pressures at which @p regions hold their fluid. */
  void
  FluidOnWall::set_trapped_pressures(SlabField          &pressure,
                                     SlabField          &open_gap,
                                     const ContactState &contact,
                                     const SlabField    &assumed,
                                     const RegionsInGap &regions) const
  {
    const FeedbackParameters &parameters = scene.fluid.feedback;
    const std::vector<double> now        = regions.mean_over_widest_points(assumed);
    const std::vector<double> on_shut = regions.mean_over_widest_points(contact.pressure);
    std::vector<double>       next(now);
    for (std::size_t r = 0; r < next.size(); ++r)
      if (r < known.regions.size())
        {
          // A region that is pressed shut opens once its fluid has taken over the contact
          // pressure: that pressure counts as a negative volume.
          const TrappedRegion &region = known.regions[r];
          const double         volume = regions.volumes[r] > 0. ? regions.volumes[r]
                                                                : -region.compliance * on_shut[r];
          next[r] = pressure_to_hold(parameters, region, volume, now[r]);
        }
      else if (!has_initial_extension)
        next[r] = parameters.pool_pressure;
    for (std::size_t k = 0; k < pressure.size(); ++k)
      if (const int r = regions.region_of_point[k]; r >= 0)
        {
          pressure[k] = next[r];
          // At its widest points the pressure is known, even if all of them are shut.
          const double gap = std::max(open_gap[k], std::numeric_limits<double>::min());
          open_gap[k]      = regions.is_widest(k) ? -gap : gap;
        }
  }

  bool
  FluidOnWall::settle(const ContactState &contact,
                      const StepFlow     &fluid_flow,
                      const SlabField    &pressure)
  {
    if (!found)
      return false;
    const SlabField          gap = open_gap(contact.gap, control.slip_length);
    const RegionsInGap       regions(known, gap, fluid_flow.channel.clusters);
    std::optional<SlabField> before;
    if (past != nullptr)
      before = open_gap(past->gap(), past->control.slip_length);
    RegionsInGap::Settled settled =
      regions.settle(scene.fluid.feedback,
                     regions.mean_over_widest_points(pressure),
                     scene.contact.effective_modulus,
                     before ? &*before : nullptr);
    found = std::move(settled.fluid);
    found->uncertainty += known.uncertainty;
    if (settled.has_changed)
      known = *found;
    return settled.has_changed;
  }
} // namespace strait
