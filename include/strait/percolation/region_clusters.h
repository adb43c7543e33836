// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_region_clusters_h
#define strait_percolation_region_clusters_h

#include <strait/percolation/clusters.h>

namespace strait
{
  /** find_clusters() for a @p domain that is a region, on rank 0, whose memory it needs
   *  for 17 B a grid point. Collective. */
  Clusters find_clusters_in_region(const SlabField &open_gap, const FlowDomain &domain);
} // namespace strait

#endif
