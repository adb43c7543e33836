// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/seal_state.h>

namespace strait
{
  bool
  holds_under(const Control &control, const SealState &state)
  {
    const Control &own = state.control;
    const bool     has_windows =
      !state.gap().empty() && !state.gap().layout().windows().empty();
    return (!state.contact || own.target == control.target) &&
           (!state.fluid || own.inlet_pressure == control.inlet_pressure) &&
           (!(state.fluid || has_windows) || own.slip_length == control.slip_length);
  }

  bool
  changes_verdict(const SealState &from, const SealState &state)
  {
    return from.fluid && !from.fluid->lifted_off && state.fluid &&
           from.fluid->percolates != state.fluid->percolates;
  }

  SlabField
  signed_gap(const SealState &state, const double softness)
  {
    SlabField result = state.gap();
    for (std::size_t k = 0; k < result.size(); ++k)
      if (state.contact->pressure[k] > 0)
        result[k] = -softness * state.contact->pressure[k];
    return result;
  }

  void
  transfer(StateArchive &archive, SealState &state, const SlabLayoutPtr &layout)
  {
    archive.value(state.control);
    if (transfer_presence(archive, state.contact))
      transfer(archive, *state.contact, layout);
    archive.value(state.mean_gap);
    if (transfer_presence(archive, state.fluid))
      {
        FluidState &fluid = *state.fluid;
        archive.field(fluid.pressure, layout);
        archive.value(fluid.load);
        if (transfer_presence(archive, fluid.trapped))
          {
            TrappedFluid &trapped = *fluid.trapped;
            archive.field(trapped.owner, *layout);
            archive.values(trapped.regions,
                           trapped.area,
                           trapped.guessed_area,
                           trapped.pressure,
                           trapped.uncertainty);
          }
        archive.values(fluid.mesh_error,
                       fluid.percolates,
                       fluid.converged,
                       fluid.lifted_off);
      }
    Costs &costs = state.costs; // except the time, which another run has spent
    archive.values(state.trend, costs.iterations, costs.fft_pairs, costs.rounds);
  }
} // namespace strait
