// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_grid_point_h
#define strait_percolation_grid_point_h

namespace strait
{
  /** A grid point; along the flow, index n stands for the outlet's copy of 0. Or a point
   *  of a window. */
  struct GridPoint
  {
    int ix     = 0;
    int iy     = 0;
    int window = -1; // −1: the grid

    bool
    operator==(const GridPoint &other) const
    {
      return ix == other.ix && iy == other.iy && window == other.window;
    }
  };
} // namespace strait

#endif
