// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_critical_cells_h
#define strait_flow_critical_cells_h

#include <strait/percolation/channel.h>
#include <strait/spectral/grid_cell.h>

#include <vector>

namespace strait
{
  /** Exponent of the cells that a flow computation starts with where nothing is
   *  critical: 2^6 spacings, but no fewer than eight cells in a direction. */
  int largest_start_exponent(const PeriodicGrid &grid);

  /**
   * The cells of the grid's quadtree, no larger than those that a computation starts
   * with, that are too coarse to start it with, told from the gap of @p channel alone.
   * Sorted, the same on all ranks; none where there is no path.
   *
   * The pressure is estimated as 1 − r/R, where r is ∫ ds/g³ from the inlet along the
   * first path and R that of the whole path (estimate_pressure()). A cell is too coarse
   * - if the flow would take a short cut through it: K (Δp)² exceeds a fraction of the
   *   leak rate's estimate, with Δp the range of the pressure over the cell and its
   *   neighbours. That finds the barriers between high and low pressure, however
   *   thin, and leaves alone those with the same pressure on both sides;
   * - if it blocks a path: where one runs, the mean of 1/K exceeds a fraction of the
   *   path's own resistance.
   *
   * Both are told from the grid's points, of cells of two spacings or more. Where the
   * narrowest point of a constriction lies in a window, cells_around_throats() are added.
   *
   * Runs on rank 0, whose memory it needs for some 40 B a grid point. Collective.
   */
  std::vector<GridCell> find_critical_cells(const Channel &channel);
} // namespace strait

#endif
