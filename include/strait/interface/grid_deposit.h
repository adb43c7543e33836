// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_interface_grid_deposit_h
#define strait_interface_grid_deposit_h

#include <strait/spectral/periodic_grid.h>
#include <strait/spectral/slab_field.h>

#include <map>
#include <vector>

namespace strait
{
  /**
   * The way back over the bridge, from cells to the grid: a function f on cells of
   * the quadtree becomes the sums ∫ f N_i over the bilinear hat functions N_i of the
   * grid points i, the transpose of interpolation from the grid. The hats add up to
   * one, so nothing is lost: the sum over the points is ∫ f over the cells, to
   * rounding.
   */
  class GridDeposit
  {
  public:
    /** For functions that are polynomials of degree @p degree, 1 or 2, on each cell. */
    GridDeposit(SlabLayoutPtr layout, unsigned int degree);

    /**
     * Add the function on @p cell with the values @p values at its (degree + 1)²
     * equidistant nodes, row by row. Cells of any rank.
     */
    void add(const GridCell &cell, const std::vector<double> &values);

    /** Integrals over hat functions, in units of the area of a grid cell. */
    struct Sums
    {
      SlabField integral; // ∫ f N_i
      SlabField area;     // ∫ N_i over the cells that were added
    };

    /** What all ranks have added. Collective. */
    Sums collect();

  private:
    /** Sums at the points of one row. */
    struct Row
    {
      std::vector<double> integral, area;
    };

    SlabLayoutPtr      layout;
    unsigned int       degree;
    std::map<int, Row> rows; // that this rank's cells touch
  };
} // namespace strait

#endif
