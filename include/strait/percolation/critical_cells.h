// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_critical_cells_h
#define strait_percolation_critical_cells_h

#include <strait/percolation/flow_path.h>
#include <strait/spectral/grid_cell.h>

#include <vector>

namespace strait
{
  /** Exponent of the cells that a flow computation starts with where nothing is
   *  critical: 2^6 spacings, but no fewer than eight cells in a direction. */
  int largest_start_exponent(const PeriodicGrid &grid);

  /**
   * The cells of the grid's quadtree, of at most 2^@p largest_exponent and at least
   * two spacings, that are too coarse to start a flow computation with, told from
   * the gap alone. Sorted.
   *
   * The pressure is estimated as 1 − r/R, where @p resistance r is the least ∫ ds/g³
   * from the inlet to a point of the lattice (infinity: not reached) and R that of
   * the first of @p paths. A cell is too coarse
   * - if the flow would take a short cut through it: K (Δp)² exceeds a share of the
   *   leak rate's estimate, with Δp the range of the pressure over the cell and its
   *   neighbours. That finds the barriers between high and low pressure, however
   *   thin, and leaves alone those with the same pressure on both sides;
   * - if it blocks a path: where one runs, the mean of 1/K exceeds a share of the
   *   path's own resistance.
   */
  std::vector<GridCell> find_critical_cells(const FlowLattice           &gap,
                                            const std::vector<double>   &resistance,
                                            const std::vector<FlowPath> &paths,
                                            FlowDirection                direction,
                                            int largest_exponent);
} // namespace strait

#endif
