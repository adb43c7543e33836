// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_solution_on_grid_h
#define strait_flow_solution_on_grid_h

#include <strait/interface/grid_deposit.h>

#include <vector>

namespace strait
{
  class ReynoldsSolver;

  /**
   * The potential of @p solver (1 at the inlet, 0 at the outlet), handed from its open
   * cells to the points of the grid without loss. Collective.
   */
  GridDeposit::Sums pressure_on_grid(const ReynoldsSolver &solver,
                                     const SlabLayoutPtr  &layout);

  /** The flow at every so many grid points in both directions, row by row. */
  struct FlowOnRaster
  {
    std::vector<float> pressure; // 1 at the inlet, 0 at the outlet
    std::vector<float> current;  // density of a leak of 1 [1/length]
  };

  /**
   * For pictures: the flow at every @p stride-th grid point from (0, 0) on, complete on
   * rank 0. The current is |∇ψ| of the stream function: unlike K∇p that does not carry
   * the grid's fine structure of K across coarse cells. Collective.
   */
  FlowOnRaster flow_on_raster(const ReynoldsSolver &solver, int stride);
} // namespace strait

#endif
