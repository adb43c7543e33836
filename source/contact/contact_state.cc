// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/contact_state.h>

namespace strait
{
  namespace
  {
    void
    transfer_relaxation(StateArchive &archive, std::vector<RelaxationStep> &relaxation)
    {
      auto n_steps = static_cast<long>(relaxation.size());
      archive.value(n_steps);
      relaxation.resize(n_steps);
      for (RelaxationStep &step : relaxation)
        {
          archive.value(step.iteration);
          archive.value(step.energy);
          archive.value(step.residual);
          archive.value(step.step);
        }
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
    bool is_adhesive = state.adhesion.has_value();
    archive.value(is_adhesive);
    if (!is_adhesive)
      return;
    if (archive.is_reading())
      state.adhesion.emplace();
    archive.value(state.adhesion->adhesive_energy);
    archive.value(state.adhesion->total_energy);
    archive.value(state.adhesion->smallest_curvature);
    archive.value(state.adhesion->detached);
    transfer_relaxation(archive, state.adhesion->relaxation);
  }
} // namespace strait
