// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

namespace strait
{
  /**
   * A periodic, regular grid of nx × ny points on a box of lx × ly.
   * Point (ix, iy) lies at (ix·dx, iy·dy); its global index is iy·nx + ix.
   * Lengths in the scene's unit of length.
   */
  struct PeriodicGrid
  {
    int    nx = 0;
    int    ny = 0;
    double lx = 1.;
    double ly = 1.;

    double
    dx() const
    {
      return lx / nx;
    }

    double
    dy() const
    {
      return ly / ny;
    }

    /** √(lx ly), the side of a square of this area. */
    double
    mean_side() const
    {
      return std::sqrt(lx * ly);
    }

    std::int64_t
    n_points() const
    {
      return static_cast<std::int64_t>(nx) * ny;
    }

    /** Number of times that both numbers of points can be halved. */
    int
    n_halvings() const
    {
      int n = 0;
      while (((nx >> n) & 1) == 0 && ((ny >> n) & 1) == 0)
        ++n;
      return n;
    }
  };

  /**
   * A square cell of the quadtree over the grid: its edge is 2^exponent grid
   * spacings (negative: a fraction), and (i, j) counts cells of that size from the
   * origin.
   */
  struct GridCell
  {
    int exponent = 0;
    int i        = 0;
    int j        = 0;

    /** The child @p number of the four into which the cell can be divided, row by row. */
    GridCell
    child(const int number) const
    {
      return {exponent - 1, 2 * i + number % 2, 2 * j + number / 2};
    }
  };

  /** A point of the grid or of a window. On the grid, index n along the flow stands for
   *  the outlet's copy of index 0. */
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
