// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace strait
{
  /** A path of the fluid from inlet to outlet. */
  struct FlowPath
  {
    std::vector<GridPoint> points;
    std::vector<double>    gaps;        // at the points
    std::vector<double>    resistances; // ∫ ds / gap³ from the inlet to the points
    GridPoint              bottleneck;  // the last point where the gap is smallest
    double                 bottleneck_gap = 0.; // there

    /** ∫ ds / gap³ along the whole path. */
    double
    resistance() const
    {
      return resistances.back();
    }

    /** The share of the resistance, 0 to 1, before the throat: the mean over the points
     *  before and after the bottleneck. It is thus less than 1 even at the outlet, where
     *  there may be a vacuum. */
    double
    part_before_throat() const
    {
      // The last one of points with the same gap, as for the bottleneck.
      const auto        narrowest = std::min_element(gaps.rbegin(), gaps.rend());
      const std::size_t throat    = std::distance(narrowest, gaps.rend()) - 1;
      return .5 *
             (resistances[throat == 0 ? 0 : throat - 1] +
              resistances[std::min(throat + 1, gaps.size() - 1)]) /
             resistance();
    }
  };

  /**
   * Find at most @p n_paths paths from inlet to outlet, in the order of their resistance
   * ∫ ds/gap³. Each further path avoids the throats of those before it: the points with
   * more than 5 % of the largest resistance per length, and those around them as far as
   * the nearest contact, but at least 3 and at most 32 grid spacings. No path has more
   * than 500 times the resistance of the first.
   *
   * Dijkstra's algorithm over the eight neighbours; the resistivity of a diagonal step is
   * the mean at its ends or that of its middle, whichever is larger. @p gap is positive
   * where the fluid percolates (percolating_gap()). Takes 17 B per grid point for one
   * path (LatticeSearch), 35 B for more; the result is the same on all ranks. Collective.
   */
  std::vector<FlowPath>
  find_flow_paths(const SlabField &gap, const FlowDomain &domain, unsigned int n_paths);
} // namespace strait
