// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/contact_state.h>

namespace strait
{
  namespace
  {
    void
    transfer_step(StateArchive &archive, RelaxationStep &step)
    {
      archive.value(step.iteration);
      archive.value(step.energy);
      archive.value(step.residual);
      archive.value(step.step);
    }
  } // namespace

  void
  transfer(StateArchive &archive, ContactState &state, const SlabLayoutPtr &layout)
  {
    archive.field(state.pressure, layout);
    archive.field(state.gap, layout);
    archive.value(state.nominal_pressure);
    archive.value(state.mean_gap);
    archive.value(state.contact_area);
    archive.value(state.contact_area_corrected);
    archive.value(state.residual);
    archive.value(state.iterations);
    archive.value(state.fft_pairs);
    archive.value(state.converged);
    state.approach.transfer(archive, *layout);
    if (!transfer_presence(archive, state.adhesion))
      return;
    archive.value(state.adhesion->adhesive_energy);
    archive.value(state.adhesion->total_energy);
    archive.value(state.adhesion->smallest_curvature);
    archive.value(state.adhesion->detached);
    archive.field(state.adhesion->softest_direction, *layout);
    transfer_all(archive, state.adhesion->relaxation, [&](RelaxationStep &step) {
      transfer_step(archive, step);
    });
  }
} // namespace strait
