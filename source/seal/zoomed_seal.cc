// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/grid_transfer.h>
#include <strait/percolation/bottleneck.h>
#include <strait/seal/place_windows.h>
#include <strait/seal/seal_models.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
    // Number of paths whose throats get windows. With half as many, the throat of a
    // channel that carries a tenth of the flow of a rough contact stayed coarse; twice as
    // many cost a search each, where there are as many.
    constexpr unsigned int n_paths_wanted = 6;

    /** The weakest place of the barrier of a contact that seals, as if it were a throat
     *  that reaches from its middle to where the barrier ends. */
    ThroatOnPath
    weakest_barrier(const SealState &state, const FlowDirection direction)
    {
      const Bottleneck barrier =
        find_bottleneck(open_gap(signed_gap(state, 1.), state.control.slip_length),
                        direction);
      return {barrier.point, 1., static_cast<double>(barrier.reach)};
    }

    /** Return the windows that @p state should have for @p aim. Once none is lacking
     *  along a channel, those that are not needed are left out, unless @p is_trimmed,
     *  which is then set. Collective. */
    std::vector<ZoomWindow>
    windows_for(const SealState      &state,
                const ZoomParameters &zoom,
                const FlowDirection   direction,
                const Aim             aim,
                bool                 &is_trimmed)
    {
      const SlabLayout &layout = state.gap().layout();
      // After Aim::throats has found windows, the final state only checks the first path.
      const bool         is_known = aim == Aim::leak_rate && is_trimmed;
      const unsigned int n_paths  = aim == Aim::verdict || is_known ? 1 : n_paths_wanted;
      const Channel      channel =
        make_channel(state.gap(), state.control.slip_length, direction, n_paths);
      // At this accuracy, a barrier cannot be told from a throat about to close.
      if (!channel.percolates() && aim == Aim::throats)
        return layout.windows();
      std::vector<ThroatOnPath> narrow =
        throats(channel, state.gap(), state.control.slip_length);
      if (!channel.percolates())
        narrow = {weakest_barrier(state, direction)}; // which may open on finer points
      std::vector<ZoomWindow> windows = place_windows(layout, narrow, zoom);
      if (windows == layout.windows() && channel.percolates() &&
          !std::exchange(is_trimmed, true))
        windows = needed_windows(layout, narrow, zoom);
      return windows;
    }
  } // namespace

  SealModel
  zoomed_seal(SealModel             seal,
              const ZoomParameters &zoom,
              const FlowDirection   direction,
              Log                  &log)
  {
    return [seal = std::move(seal), zoom, direction, &log](const Control   &control,
                                                           const SealState *from,
                                                           const Aim        aim) {
      // Windows for a leak rate are found at the accuracy of Aim::throats. A search has
      // its full accuracy at once: its loads are so close that windows rarely change.
      Aim       present_aim = aim == Aim::leak_rate ? Aim::throats : aim;
      SealState state       = seal(control, from, present_aim);
      bool      is_trimmed  = aim != Aim::leak_rate; // for a leak rate, once
      std::vector<std::vector<ZoomWindow>> tried;
      while (true)
        {
          if (state.fluid && state.fluid->lifted_off)
            return state; // there is no throat
          const std::vector<ZoomWindow> &present = state.gap().layout().windows();
          std::vector<ZoomWindow>        windows =
            windows_for(state, zoom, direction, present_aim, is_trimmed);
          // Throats that take windows from each other would do so for ever.
          const bool are_found =
            windows == present ||
            std::find(tried.begin(), tried.end(), windows) != tried.end();
          if (are_found && present_aim == aim)
            return state;
          if (are_found)
            {
              present_aim = aim;
              tried.clear();
            }
          else
            {
              tried.push_back(present);
              log.progress(format("  %zu windows at a load of %.8g",
                                  windows.size(),
                                  control.target));
              // Extrapolation to the next state would mix different points.
              state.contact->approach = Approach(state.contact->approach.target());
              state.contact->pressure = zoom_in(state.contact->pressure, windows);
              if (state.fluid)
                state.fluid->pressure =
                  zoom_in_linearly(state.fluid->pressure, std::move(windows));
            }
          const Costs spent = state.costs;
          state             = seal(control, &state, present_aim);
          state.costs += spent;
        }
    };
  }
} // namespace strait
