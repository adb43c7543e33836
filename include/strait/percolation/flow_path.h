// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace strait
{
  /** A way for the fluid from the inlet to the outlet. */
  struct FlowPath
  {
    std::vector<GridPoint> points;
    std::vector<double>    gaps;        // at the points
    std::vector<double>    resistances; // ∫ ds / gap³ from the inlet to the points
    GridPoint              bottleneck;  // where the gap is smallest
    double                 bottleneck_gap = 0.; // there

    /** ∫ ds / gap³ along the whole path. */
    double
    resistance() const
    {
      return resistances.back();
    }

    /** The part of the resistance, 0 to 1, before the throat: before the middle of the
     *  steps that meet at the bottleneck, and so never at the outlet, where there may be
     *  a vacuum. */
    double
    part_before_throat() const
    {
      // Of points of the same gap the last one, as the bottleneck is.
      const auto        narrowest = std::min_element(gaps.rbegin(), gaps.rend());
      const std::size_t throat    = std::distance(narrowest, gaps.rend()) - 1;
      return .5 *
             (resistances[throat == 0 ? 0 : throat - 1] +
              resistances[std::min(throat + 1, gaps.size() - 1)]) /
             resistance();
    }
  };

  /**
   * Paths from inlet to outlet in the order of their resistance ∫ ds/gap³, at most
   * @p n_paths. Each further path avoids the throats of those before it (the
   * points that offer more than 5 % of the largest resistance per length, and those
   * around them to the nearest contact, at least two grid spacings); none resists more
   * than 500 times as much as the first.
   *
   * Dijkstra's algorithm over the eight neighbours; a diagonal step is paid for at
   * the mean resistivity of its ends or that of its middle, whichever is larger. @p gap
   * is positive where the fluid percolates (percolating_gap()). It needs 17 B a grid
   * point (LatticeSearch); the result is the same on all ranks. Collective.
   */
  std::vector<FlowPath>
  find_flow_paths(const SlabField &gap, const FlowDomain &domain, unsigned int n_paths);
} // namespace strait
