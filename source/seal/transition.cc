// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/transition.h>

namespace strait
{
  void
  transfer(StateArchive &archive, std::vector<Transition> &transitions)
  {
    transfer_all(archive, transitions, [&](Transition &transition) {
      archive.values(transition.slip_length,
                     transition.lower,
                     transition.upper,
                     transition.contact_area,
                     transition.bottleneck[0],
                     transition.bottleneck[1],
                     transition.n_solves,
                     transition.fft_pairs,
                     transition.converged);
    });
  }

  const Transition *
  threshold_of(const std::vector<Transition> &thresholds, const double slip_length)
  {
    for (const Transition &threshold : thresholds)
      if (threshold.slip_length == slip_length)
        return &threshold;
    return nullptr;
  }
} // namespace strait
