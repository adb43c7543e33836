// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/zoom_in.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/zoom_placement.h>
#include <strait/seal/zoomed_seal.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace strait
{
  SealState
  ZoomedSeal::solve(const Control &control, const SealState *from, const Aim aim)
  {
    SealState state      = seal->solve(control, from, aim);
    bool      is_trimmed = aim != Aim::leak_rate; // once is enough
    std::vector<std::vector<ZoomWindow>> tried;
    while (aim != Aim::comparison)
      {
        const SlabLayout               &layout  = state.gap().layout();
        const Channel                   channel = make_channel(state.gap(),
                                             control.slip_length,
                                             direction,
                                             FlowStage::n_paths_wanted);
        const std::vector<ThroatOnPath> narrow  = throats(channel);
        std::vector<ZoomWindow>         windows = place_windows(layout, narrow, zoom);
        if (windows == layout.windows() && !std::exchange(is_trimmed, true) &&
            channel.percolates())
          windows = needed_windows(layout, narrow, zoom);
        // Throats that take windows from each other would go on for ever.
        if (windows == layout.windows() ||
            std::find(tried.begin(), tried.end(), windows) != tried.end())
          break;
        tried.push_back(layout.windows());
        log.progress(
          format("  %zu windows at a load of %.8g", windows.size(), control.target));

        const double       seconds = state.contact_seconds;
        const ContactState before =
          zoom_in(*std::move(state.contact), std::move(windows));
        state.contact = before;
        state         = seal->solve(control, &state, aim);
        state.contact_seconds += seconds;
        state.contact->iterations += before.iterations;
        state.contact->fft_pairs += before.fft_pairs;
      }
    return state;
  }
} // namespace strait
