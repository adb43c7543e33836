// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>

namespace strait
{
  /** The narrowest point of the widest path from inlet to outlet. */
  struct Bottleneck
  {
    GridPoint point;
    double    value = 0.; // of the openness there
    int       reach = 0;  // steps to the nearest point of the opposite sign; 0: none
  };

  /**
   * Find the largest value v for which the points with @p openness >= v connect inlet and
   * outlet over the four nearest neighbours, as in find_clusters(), and the narrowest
   * point of a path that attains it.
   *
   * If the openness is the gap, v is the gap of the critical constriction. If closed
   * points carry a negative number that tells how firmly they are closed, the sign of v
   * tells whether the gap percolates, and its magnitude how far it is from the threshold.
   * Takes 17 B per grid point (LatticeSearch); the result is the same on all ranks.
   * Throws InputError if the grid has no path at all through a region. Collective.
   */
  Bottleneck find_bottleneck(const SlabField &openness, const FlowDomain &domain);

  /** The position of @p point of a field on @p layout, within the box [length]. */
  std::array<double, 2> position_of(const SlabLayout &layout, const GridPoint &point);
} // namespace strait
