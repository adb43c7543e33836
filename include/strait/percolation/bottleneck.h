// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>

namespace strait
{
  /** The narrowest point of the widest way from inlet to outlet. */
  struct Bottleneck
  {
    GridPoint point;
    double    value = 0.;
    int       reach = 0; // steps to the nearest point whose value has the other sign
  };

  /**
   * The largest value v such that the points with @p openness >= v connect inlet and
   * outlet, over the four nearest neighbours as in find_clusters(), and the point
   * where a way that realises it is narrowest.
   *
   * With openness = gap the value is the gap of the critical constriction; where
   * closed points carry a negative number that tells how firmly they are closed,
   * its sign is the verdict on percolation, and both sides of the threshold say how
   * far it is. It needs 17 B a grid point (LatticeSearch); the result is the same on all
   * ranks. Collective.
   */
  Bottleneck find_bottleneck(const SlabField &openness, const FlowDomain &domain);

  /** Where @p point of a field on @p layout lies, in the box [length]. */
  std::array<double, 2> position_of(const SlabLayout &layout, const GridPoint &point);
} // namespace strait
