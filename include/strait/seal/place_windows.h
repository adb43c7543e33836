// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/percolation/channel.h>

#include <vector>

namespace strait
{
  /**
   * Return the windows with which the throats of a gap have as many points along the flow
   * as the scene wants: those of @p layout, and one or two levels more around each of the
   * @p throats that lacks points. A throat that takes a fraction f of the pressure drop
   * needs √f of those points, because its error counts by that fraction. Returns the
   * windows of @p layout if nothing is lacking.
   *
   * A new window that would touch another one of its level is joined with it. If the
   * result would be too large, the new one replaces the other if no throat needs that,
   * and is left out otherwise. Throats with the largest fraction come first.
   */
  std::vector<ZoomWindow> place_windows(const SlabLayout                &layout,
                                        const std::vector<ThroatOnPath> &throats,
                                        const ZoomParameters            &zoom);

  /** Return the windows of @p layout that @p throats need, and one level more, which is
   *  enough until they are three to nine times as short; parents of windows included. */
  std::vector<ZoomWindow> needed_windows(const SlabLayout                &layout,
                                         const std::vector<ThroatOnPath> &throats,
                                         const ZoomParameters            &zoom);
} // namespace strait
