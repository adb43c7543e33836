// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_interface_gap_levels_h
#define strait_interface_gap_levels_h

#include <strait/interface/gap_interpolant.h>
#include <strait/spectral/slab_field.h>

#include <optional>
#include <vector>

namespace strait
{
  /** The cell between four neighbouring points of one level: to the right of and above
   *  point (ix, iy) of a window, −1 for the grid. */
  struct LevelCell
  {
    int window = -1;
    int ix     = 0;
    int iy     = 0;
  };

  /**
   * The gap at the points of all levels, those of the grid around the rows of this rank.
   * A cell of which a window covers all four corners is replaced by the 3 × 3 cells of
   * the window that lie in it. The outermost rows and columns of a window thus lie
   * outside of all its cells; the interpolant needs them.
   */
  class GapLevels
  {
  public:
    explicit GapLevels(SlabLayoutPtr layout);

    /** Take a new gap, with windows of its own. Collective. */
    void update(const SlabField &gap);

    const SlabLayout &
    layout() const
    {
      return *slab_layout;
    }

    const SlabLayoutPtr &
    layout_pointer() const
    {
      return slab_layout;
    }

    /** The lower left one of the 3 × 3 cells by which a window replaces @p cell, if one
     *  does. */
    std::optional<LevelCell> first_finer_cell(const LevelCell &cell) const;

    /** The gap around a cell of a window, or of the grid in a row of this rank or the one
     *  after these. */
    GapStencil stencil(const LevelCell &cell) const;

    /** Number of points of all windows. */
    std::size_t
    n_window_points() const
    {
      return window_values.size();
    }

    /** Position of point or cell (ix, iy) of a window among those of all windows. */
    std::size_t
    position(const LevelCell &cell) const
    {
      return slab_layout->start_of_window(cell.window) - slab_layout->n_local_points() +
             static_cast<std::size_t>(cell.iy) *
               slab_layout->windows()[cell.window].n_columns() +
             cell.ix;
    }

    /** The gap between the grid's points for points with @p y_low <= y <= @p y_high; each
     *  rank may ask for others. Collective. */
    GapRows rows(const GapInterpolant &interpolant, double y_low, double y_high) const;

    /** Forget the gap. */
    void
    release()
    {
      grid_rows     = {};
      window_values = {};
    }

  private:
    SlabLayoutPtr       slab_layout;
    std::vector<double> grid_rows; // one row before, three after the own ones
    std::vector<double> window_values;
  };
} // namespace strait

#endif
