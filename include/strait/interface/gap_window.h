// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_interface_gap_window_h
#define strait_interface_gap_window_h

#include <strait/interface/gap_interpolant.h>
#include <strait/spectral/periodic_grid.h>

#include <vector>

namespace strait
{
  /** The gap between some rows of the grid, for cells that are not the grid's own. */
  class GapWindow
  {
  public:
    /**
     * @p rows holds the grid rows that follow each other from @p first_row on, one
     * before and two after those that points may lie above.
     */
    GapWindow(const PeriodicGrid   &grid,
              const GapInterpolant &interpolant,
              int                   first_row,
              std::vector<double>   rows);

    /** The gap at a point of the box, not below zero. */
    double operator()(double x, double y) const;

  private:
    PeriodicGrid        grid;
    GapInterpolant      interpolant;
    int                 first_row;
    std::vector<double> rows;
  };
} // namespace strait

#endif
