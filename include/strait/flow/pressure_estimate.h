// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_pressure_estimate_h
#define strait_flow_pressure_estimate_h

#include <strait/percolation/flow_path.h>

#include <vector>

namespace strait
{
  /**
   * Estimate of the fluid's pressure, 1 at the inlet and 0 at the outlet, at the open
   * points of the lattice: 1 − r/R on @p path, elsewhere that of the point of the path
   * from which the widest way comes; −1 at closed points. r is ∫ ds/g³ from the inlet,
   * R that of the whole path.
   */
  std::vector<float> estimate_pressure(const FlowLattice &gap, const FlowPath &path);
} // namespace strait

#endif
