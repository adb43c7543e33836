// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/percolation/channel.h>

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
} // namespace strait
