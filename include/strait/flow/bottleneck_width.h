// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_bottleneck_width_h
#define strait_flow_bottleneck_width_h

#include <strait/percolation/flow_path.h>

namespace strait
{
  /**
   * ∫ (g/g0)³ dt across the channel at the bottleneck of @p path, where the gap is g0
   * [length]: over the points of its level in the direction, of four, where that is
   * least;
   * @p otherwise where the gap is widest at the bottleneck in none. On rank 0, where
   * @p lattice holds the values of the grid of @p gap.
   */
  double bottleneck_width(const SlabField   &gap,
                          const FlowLattice &lattice,
                          const FlowPath    &path,
                          double             otherwise);
} // namespace strait

#endif
