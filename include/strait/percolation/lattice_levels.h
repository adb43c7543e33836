// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_lattice_levels_h
#define strait_percolation_lattice_levels_h

#include <strait/percolation/grid_lines.h>
#include <strait/percolation/grid_point.h>

#include <array>
#include <cstddef>
#include <vector>

namespace strait
{
  /**
   * The grid and its windows turned so that the flow runs along, from the inlet to the
   * outlet's copy of the seam. A window that crosses the seam is two levels.
   */
  class LatticeLevels
  {
  public:
    /** The grid, or a window. */
    struct Level
    {
      std::size_t           begin; // number of its first point
      int                   n_along;
      int                   n_across;
      std::array<double, 3> lengths;             // of steps along, across and diagonally
      std::ptrdiff_t        along_by, across_by; // steps in the numbers of its points
      int                   parent; // its level, and the first of its points that the
      int                   along;  // window covers
      int                   across;

      // Of a window across the seam there are two parts: that on the side of the outlet,
      // which ends with the outlet's copy of the seam, and that which begins with it.
      int  window          = -1;
      int  first           = 0; // its first column, along the flow, in the window
      bool begins_at_inlet = false;
      bool ends_at_outlet  = false;

      /** How many points to each side are there for interpolation only. */
      int
      rim() const
      {
        return window < 0 ? 0 : 1;
      }
    };

    /** A point by its level, column along the flow and row across it. */
    struct Place
    {
      int level;
      int along;
      int across;
    };

    /** Numbers of windows' points follow those of @p lines. */
    LatticeLevels(const SlabLayout &layout,
                  const FlowDomain &domain,
                  const GridLines  &lines);

    /** The grid, then the windows, each after its parent. */
    const Level &
    operator[](const int level) const
    {
      return levels[level];
    }

    int
    size() const
    {
      return static_cast<int>(levels.size());
    }

    /** The number after that of the last point. */
    std::size_t
    end() const
    {
      return size() == 1
               ? n_on_grid
               : levels.back().begin + static_cast<std::size_t>(levels.back().n_along) *
                                         levels.back().n_across;
    }

    /** The level of point @p k, 0 for the grid. */
    int
    level_of(const std::size_t k) const
    {
      int level = 0;
      if (k >= n_on_grid)
        for (level = static_cast<int>(levels.size()) - 1; k < levels[level].begin;)
          --level;
      return level;
    }

    /** A point of the grid across the flow, within the period. */
    int
    wrapped(const int across) const
    {
      const int n = levels.front().n_across;
      return !is_periodic ? across : ((across % n) + n) % n;
    }

    /** The point of the next finer level that point @p p is; itself if no window covers
     *  it. */
    Place finer(const Place &p) const;

    /** The point of the finest level that point @p p is. */
    Place finest(const Place &p) const;

    /** Whether a point of a window is one of its parent's points, and on the rim of what
     *  the window covers of those. */
    bool is_on_rim(const Place &p) const;

    /** The point of the parent that stands for a point of a window. */
    Place parent_of(const Place &p) const;

    /** The place of point @p p, on the seam that at the inlet. */
    Place place(const GridPoint &p) const;

    /** The point of the grid or of a window at a place. */
    GridPoint point(const Place &p) const;

    /** The point of the grid that stands for point @p p. */
    GridPoint on_grid(const GridPoint &p) const;

    const bool along_x;     // the flow
    const bool is_periodic; // across it

  private:
    /** Columns of a window, along the flow: all, or those on one side of the seam. */
    struct Part
    {
      int  first;
      int  last;
      bool begins_at_inlet;
      bool ends_at_outlet;
    };

    void add_window(const SlabLayout &layout, int w);
    void add_part(const SlabLayout &layout, int w, const Part &part);

    /** The level with column @p along of a window, −1 for the grid; of a column on the
     *  seam the copy at the outlet if @p of_outlet, else that at the inlet. */
    int level_with(int window, int along, bool of_outlet) const;

    std::size_t        n_on_grid;
    std::vector<Level> levels;
  };
} // namespace strait

#endif
