// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <cstdint>
#include <vector>

namespace strait
{
  /**
   * The gap that the fluid sees, g − 2|d0| [length]: what is left of @p gap between
   * immobile layers of fluid on both walls, each −@p slip_length thick; a positive slip
   * length widens it. The fluid can enter where it is positive.
   */
  inline double
  open_gap(const double gap, const double slip_length)
  {
    return gap + 2. * slip_length;
  }

  /** The same of a whole field. */
  SlabField open_gap(SlabField gap, double slip_length);

  /** What a grid point is to the fluid. */
  enum class NodeState : std::uint8_t
  {
    closed,      // no gap that the fluid can enter
    trapped,     // open, joined to neither reservoir
    inlet_side,  // open, joined to the inlet only
    outlet_side, // open, joined to the outlet only
    percolating, // open, joined to both
    outside      // of the region in which the fluid flows
  };

  /** The clusters of open grid points, and whether one of them leaks. */
  struct Clusters
  {
    std::vector<NodeState> states; // one per value of a field
    std::vector<GridPoint> leaks;  // percolating points at the outlet, on all ranks
    bool                   percolates = false;

    /** If asked for, one per value as well: which cluster it belongs to where fluid is
     *  trapped, by the number of its first point, so that it does not depend on the
     *  number of ranks; −1 elsewhere. */
    std::vector<std::int64_t> trapped;
  };

  /**
   * Label the points where @p open_gap > 0. Neighbours are the four nearest
   * points; the grid is periodic across the flow. Along the flow, the points at
   * coordinate 0 touch the inlet, and a point of the last line touches the outlet
   * if the point behind it, across the periodic seam, is open as well. In a region
   * neighbours, inlet and outlet are those of FlowRegion; all is done on rank 0.
   *
   * Where the layout has windows, neighbours are points of one level, and coinciding
   * points are one and the same. Points that the same window covers are joined by the
   * window's finer points alone. The outermost points of a window join nothing, and are
   * of the cluster of the point inside of them.
   *
   * This function is the one place that decides what is open. Those of trapped fluid are
   * told apart if @p tells_trapped, which needs a box. Collective.
   */
  Clusters find_clusters(const SlabField  &open_gap,
                         const FlowDomain &domain,
                         bool              tells_trapped = false);
} // namespace strait
