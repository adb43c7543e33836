// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_interface_grid_deposit_h
#define strait_interface_grid_deposit_h

#include <strait/spectral/periodic_grid.h>
#include <strait/spectral/slab_field.h>

#include <map>
#include <utility>
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
    /**
     * ∫ φ_k N_n dx over a cell along one axis, for its nodal polynomials φ_k and the
     * hats of the grid points n that it touches, in units of the grid spacing.
     */
    struct Weights
    {
      int                 n = 0;  // number of grid points
      std::vector<double> values; // [k·n + point]
    };
    /** Sums at the points of one row. */
    struct Row
    {
      std::vector<double> integral, area;
    };

    const Weights &weights(int exponent, int index_in_grid_cell);

    SlabLayoutPtr                          layout;
    unsigned int                           degree;
    std::map<std::pair<int, int>, Weights> known_weights;
    std::map<int, Row>                     rows; // that this rank's cells touch
  };
} // namespace strait

#endif
