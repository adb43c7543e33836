// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <cstdint>
#include <vector>

namespace strait
{
  /**
   * The gap that the fluid sees [length]: what is left of @p gap between immobile layers
   * of fluid on both walls, each −@p slip_length thick; a positive slip length widens it.
   * The fluid can enter where it is positive.
   */
  inline double
  open_gap(const double gap, const double slip_length)
  {
    return gap + 2. * slip_length;
  }

  /** The open gap of a whole field. */
  SlabField open_gap(SlabField gap, double slip_length);

  /** The state of a grid point as the fluid sees it. */
  enum class NodeState : std::uint8_t
  {
    closed,      // no gap that the fluid can enter
    trapped,     // open, joined to neither reservoir
    inlet_side,  // open, joined to the inlet only
    outlet_side, // open, joined to the outlet only
    percolating, // open, joined to both
    outside      // not in the region in which the fluid flows
  };

  /** The clusters of open grid points, and whether one of them leaks. */
  struct Clusters
  {
    std::vector<NodeState> states; // one per value of a field
    std::vector<GridPoint> leaks;  // percolating points at the outlet, of all ranks
    bool                   percolates = false;

    /** If asked for, one per value as well: the cluster of trapped fluid, named by the
     *  number of its first point, which does not depend on the number of ranks; −1 where
     *  no fluid is trapped. */
    std::vector<std::int64_t> trapped;
  };

  /**
   * Find the clusters of points where @p open_gap > 0. Neighbours are the four nearest
   * points; the grid is periodic across the flow. Along the flow, the points at
   * coordinate 0 touch the inlet, and a point of the last line touches the outlet
   * if the point behind it, across the periodic seam, is open as well. In a region,
   * neighbours, inlet and outlet are those of FlowRegion, and rank 0 does all the work.
   *
   * If the layout has windows, neighbours are points of one level, and coinciding points
   * count as one. Points that the same window covers are joined through the window's
   * finer points alone. The outermost points of a window join nothing, and take the
   * cluster of the point next to them inside.
   *
   * Only this function decides what is open. Clusters of trapped fluid are told apart if
   * @p tells_trapped, which only the whole box supports. Collective.
   */
  Clusters find_clusters(const SlabField  &open_gap,
                         const FlowDomain &domain,
                         bool              tells_trapped = false);
} // namespace strait
