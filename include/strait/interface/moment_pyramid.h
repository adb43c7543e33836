// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_interface_moment_pyramid_h
#define strait_interface_moment_pyramid_h

#include <strait/interface/moment_set.h>
#include <strait/spectral/periodic_grid.h>
#include <strait/spectral/slab_field.h>

#include <functional>
#include <vector>

namespace strait
{
  /**
   * Moments of a coefficient on every quadtree cell of four grid spacings or more,
   * summed bottom-up, so that any coarse cell is looked up in O(1). A rank holds
   * the cells whose first grid row it owns. 5/12 · 8 B a grid point at degree 1; with
   * those of two spacings it would be four times as much, for few that are asked for.
   */
  class MomentPyramid
  {
  public:
    /** The exponent of the smallest cells. */
    static constexpr int finest = 2;

    /** Writes the moments of the grid cell (ix, iy), which are zero so far, and returns
     *  whether they no longer are. */
    using Leaf = std::function<bool(int ix, int iy, double *moments)>;

    /** Sum up all levels from the grid cells of this rank. Collective. */
    MomentPyramid(SlabLayoutPtr layout, MomentSet set, int n_halvings, const Leaf &leaf);

    /** Moments of a cell of this rank with finest <= exponent <= n_halvings. */
    const double *moments(const GridCell &cell) const;

  private:
    // Rows of cells that this rank's grid rows touch; the first may belong to the
    // rank before, which is sent this rank's share of it.
    struct Level
    {
      int                 n_columns = 0;
      int                 first_row = 0;
      int                 n_rows    = 0;
      std::vector<double> moments;
    };

    void sum_grid_cells(const Leaf &leaf);
    void sum_children(const Level &fine, Level &coarse) const;
    void complete_first_rows();

    SlabLayoutPtr      layout;
    MomentSet          set;
    std::vector<Level> levels; // levels[k] has cells of exponent finest + k
  };
} // namespace strait

#endif
