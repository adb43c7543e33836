// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strait
{
  /**
   * The points of the grid and its windows as this rank numbers them, turned so that the
   * flow runs along, from the inlet to the outlet's copy of the seam. A window that
   * crosses the seam is two levels, whose points all ranks know.
   *
   * Of the grid a rank owns the lines of constant y that are its rows, with the outlet's
   * copy of the seam, and knows the line before and the one after them, its ghosts.
   * Across a flow along x lines follow each other periodically; a ghost may then be the
   * rank's own line as well. Of a region rank 0 owns all lines, which are those of
   * FlowRegion.
   */
  class LatticeLevels
  {
  public:
    /** The grid, or a window. */
    struct Level
    {
      int                   n_along;
      int                   n_across;
      std::array<double, 3> lengths;             // of steps along, across and diagonally
      std::ptrdiff_t        along_by, across_by; // steps in the numbers of its points

      std::size_t begin  = 0;  // number of its first point
      int         parent = -1; // its level, and the first of its points that the window
      int         along  = 0;  // covers
      int         across = 0;

      // Of a window across the seam there are two parts: that on the side of the outlet,
      // which ends with the outlet's copy of the seam, and that which begins with it. The
      // grid does both, other windows neither.
      int  window          = -1;
      int  first           = 0; // its first column, along the flow, in the window
      bool begins_at_inlet = true;
      bool ends_at_outlet  = true;

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

    LatticeLevels(const SlabLayout &layout, const FlowDomain &domain);

    const bool along_x;     // the flow
    const bool is_periodic; // across it

    // Of the grid: number of points of a line, the first line that this rank knows, −1
    // for that before line 0, and the one after the last; number of points on these,
    // which come before those of windows, the first of them that is on a line of this
    // rank's own, and the one after the last such.
    int         length;
    int         first = 0, end = 0;
    std::size_t n_on_grid = 0, first_own = 0, end_own = 0;

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

    /** Number of all points that this rank knows. */
    std::size_t
    n_points() const
    {
      const Level &last = levels.back();
      return size() == 1
               ? n_on_grid
               : last.begin + static_cast<std::size_t>(last.n_along) * last.n_across;
    }

    /** Number of no point. */
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /** The number of point @p i of line @p line; none if this rank does not know it. */
    std::size_t
    number_of(const int line, const int i) const
    {
      return line < first || line >= end || i < 0 || i >= length
               ? none
               : static_cast<std::size_t>(line - first) * length + i;
    }

    /** Which of this rank's lines point @p k of the grid is on. Half a point keeps the
     *  product away from whole numbers: a division takes longer than a step of a search.
     */
    std::size_t
    line_of(const std::size_t k) const
    {
      return static_cast<std::int64_t>(
        (static_cast<double>(static_cast<std::int64_t>(k)) + .5) * lines_per_point);
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

  private:
    void find_lines(const SlabLayout &layout);
    void add_window(const SlabLayout &layout, int w);

    /** The level with column @p along of a window, −1 for the grid; of a column on the
     *  seam the copy at the outlet if @p of_outlet, else that at the inlet. */
    int level_with(int window, int along, bool of_outlet) const;

    double             lines_per_point;
    std::vector<Level> levels;
  };
} // namespace strait
