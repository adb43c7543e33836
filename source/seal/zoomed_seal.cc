// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/zoom_in.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/zoom_placement.h>
#include <strait/seal/zoomed_seal.h>

#include <vector>

namespace strait
{
  SealState
  ZoomedSeal::solve(const Control &control, const SealState *from, const Aim aim)
  {
    SealState state = seal->solve(control, from, aim);
    while (aim != Aim::comparison)
      {
        const Channel           channel = make_channel(state.gap(),
                                             control.slip_length,
                                             direction,
                                             FlowStage::n_paths_wanted);
        std::vector<ZoomWindow> windows =
          place_windows(state.gap().layout(), throats(channel), zoom, direction);
        if (windows == state.gap().layout().windows())
          break;
        log.progress(
          format("  %zu windows at a load of %.8g", windows.size(), control.target));

        const ContactState before =
          zoom_in(*std::move(state.contact), std::move(windows));
        const double seconds = state.contact_seconds;
        state.contact        = before;
        state                = seal->solve(control, &state, aim);
        state.contact_seconds += seconds;
        state.contact->iterations += before.iterations;
        state.contact->fft_pairs += before.fft_pairs;
      }
    return state;
  }
} // namespace strait
