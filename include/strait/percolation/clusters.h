// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_clusters_h
#define strait_percolation_clusters_h

#include <strait/percolation/flow_domain.h>
#include <strait/spectral/slab_field.h>

#include <cstdint>
#include <vector>

namespace strait
{
  /** What a grid point is to the fluid. */
  enum class NodeState : std::uint8_t
  {
    closed,      // no gap that the fluid can enter
    pocket,      // open, joined to neither reservoir
    inlet_side,  // open, joined to the inlet only
    outlet_side, // open, joined to the outlet only
    percolating, // open, joined to both
    outside      // of the region in which the fluid flows
  };

  /** The clusters of open grid points, and whether one of them leaks. */
  struct Clusters
  {
    std::vector<NodeState> states; // one per local grid point
    bool                   percolates           = false;
    double                 open_fraction        = 0.; // of all points of the domain
    double                 percolating_fraction = 0.;
  };

  /**
   * Label the points where @p flow_gap > 0. Neighbours are the four nearest
   * points; the grid is periodic across the flow. Along the flow, the points at
   * coordinate 0 touch the inlet, and a point of the last line touches the outlet
   * if the point behind it, across the periodic seam, is open as well. In a region
   * neighbours, inlet and outlet are those of FlowRegion; all is done on rank 0.
   *
   * @p flow_gap is the gap that the fluid sees, g − 2|d0| with slip length d0;
   * this function is the one place that decides what is open. Distributed
   * union–find; collective.
   */
  Clusters find_clusters(const SlabField &flow_gap, const FlowDomain &domain);
} // namespace strait

#endif
