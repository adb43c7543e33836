// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_pressure_on_grid_h
#define strait_flow_pressure_on_grid_h

#include <strait/flow/reynolds_solver.h>
#include <strait/interface/grid_deposit.h>

namespace strait
{
  /**
   * The potential of @p solver (1 at the inlet, 0 at the outlet), handed from its open
   * cells to the points of the grid without loss. Collective.
   */
  GridDeposit::Sums pressure_on_grid(const ReynoldsSolver &solver,
                                     const SlabLayoutPtr  &layout);
} // namespace strait

#endif
