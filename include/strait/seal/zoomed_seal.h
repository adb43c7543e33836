// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_zoomed_seal_h
#define strait_seal_zoomed_seal_h

#include <strait/base/contact_parameters.h>
#include <strait/base/log.h>
#include <strait/percolation/channel.h>
#include <strait/seal/seal_state.h>

#include <vector>

namespace strait
{
  /**
   * The windows that a gap needs so that its throats have as many points along the flow
   * as the scene wants: those that @p layout has, and what the @p throats of a channel
   * lack, one level more for each at a time. A throat at which a fraction f of the
   * pressure drops needs √f of those points, for its error counts by that fraction.
   * Returns those of @p layout where nothing is lacking.
   *
   * A new window that would touch another one of its level is joined with it or, where
   * that would be too large, left out, unless no throat lies in the other; throats that
   * matter most come first.
   */
  std::vector<ZoomWindow> place_windows(const SlabLayout                &layout,
                                        const std::vector<ThroatOnPath> &throats,
                                        const ZoomParameters            &zoom);

  /** The windows of @p layout that @p throats need, or would if they were three to nine
   *  times as short; parents of others among them. */
  std::vector<ZoomWindow> needed_windows(const SlabLayout                &layout,
                                         const std::vector<ThroatOnPath> &throats,
                                         const ZoomParameters            &zoom);

  /**
   * A dry @p seal whose throats are resolved: where a channel percolates, the state gets
   * the windows that its throats lack, one level after the other, and is solved again.
   * Where none does, so does the barrier where it is weakest, for on finer points it may
   * be open. For a leak rate half of the digits are enough while windows are sought, the
   * state that is returned has all of them. The state keeps those of the state that it
   * came from, so that neighbouring states have the same points. The reference must
   * outlive the model.
   */
  SealModel zoomed_seal(SealModel             seal,
                        const ZoomParameters &zoom,
                        FlowDirection         direction,
                        Log                  &log);
} // namespace strait

#endif
