// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_solution_on_grid_h
#define strait_flow_solution_on_grid_h

#include <strait/flow/grid_points.h>
#include <strait/interface/grid_deposit.h>

#include <vector>

namespace strait
{
  class ReynoldsSolver;

  /**
   * The potential of @p solver (1 at the inlet, 0 at the outlet), handed from its open
   * cells to the points of the grid without loss. Collective.
   */
  GridDeposit::Sums potential_on_grid(const ReynoldsSolver &solver,
                                      const SlabLayoutPtr  &layout);

  /** The flow at some points, row by row. */
  struct FlowAtPoints
  {
    std::vector<float> pressure; // 1 at the inlet, 0 at the outlet
    std::vector<float> current;  // density of a leak of 1 [1/length]
  };

  /**
   * For pictures: the flow at the points of @p rows, complete on rank 0. The current is
   * |∇ψ| of the stream function: unlike K∇p that does not carry the grid's fine structure
   * of K across coarse cells. Collective.
   */
  FlowAtPoints flow_at_points(const ReynoldsSolver &solver, const PointRows &rows);
} // namespace strait

#endif
