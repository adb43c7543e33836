// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_percolating_gap_h
#define strait_percolation_percolating_gap_h

#include <strait/percolation/clusters.h>

namespace strait
{
  /**
   * What the flow solver may see of @p flow_gap: its value at percolating points,
   * zero at other open points, and the value itself (<= 0) at closed points, so
   * that an interpolant crosses zero where the threshold lies. Closed values are
   * raised to no less than minus the smallest percolating gap beside them: a channel
   * one point wide stays open for half a spacing to each side.
   *
   * A point on the seam belongs to the inlet and, as a copy, to the outlet; it is
   * kept if either of the two percolates. Points outside a region that are no more than
   * two spacings from a percolating one keep their value, since the gap between that
   * and the outline is interpolated with them. Collective.
   */
  SlabField percolating_gap(const SlabField  &flow_gap,
                            const Clusters   &clusters,
                            const FlowDomain &domain);
} // namespace strait

#endif
