// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_grid_cell_h
#define strait_spectral_grid_cell_h

namespace strait
{
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

    bool
    operator==(const GridCell &other) const
    {
      return exponent == other.exponent && i == other.i && j == other.j;
    }
  };
} // namespace strait

#endif
