// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/seal_state.h>

namespace strait
{
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
    archive.value(state.control.target);
    archive.value(state.control.inlet_pressure);
    archive.value(state.control.slip_length);
    if (transfer_presence(archive, state.contact))
      transfer(archive, *state.contact, layout);
    archive.value(state.mean_gap);
    if (transfer_presence(archive, state.fluid))
      {
        archive.field(state.fluid->pressure, layout);
        archive.value(state.fluid->load);
        if (transfer_presence(archive, state.fluid->trapped))
          transfer(archive, *state.fluid->trapped, *layout);
        archive.value(state.fluid->rounds);
        archive.value(state.fluid->mesh_error);
        archive.value(state.fluid->converged);
        archive.value(state.fluid->undecided);
        archive.value(state.fluid->open_share);
        archive.value(state.fluid->lifted_off);
      }
    archive.value(state.trend.is_known);
    archive.value(state.trend.area);
    archive.value(state.trend.slope);
    archive.value(state.trend.largest_slope);
  }
} // namespace strait
