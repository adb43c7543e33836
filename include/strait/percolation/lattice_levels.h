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
   * The points of the grid and its windows as this rank numbers them. Their coordinates
   * are turned: "along" runs with the flow, from the inlet to the outlet's copy of the
   * seam, and "across" normal to it. All ranks know the points of windows; a window that
   * crosses the seam makes two levels.
   *
   * A line is a row of the grid, of constant y. A rank owns its rows, with the outlet's
   * copy of the seam, and knows the lines before and after them, its ghosts. If the flow
   * is along x, lines repeat periodically, and a ghost may be a line of the rank's own as
   * well. In a region rank 0 owns all lines, which are those of FlowRegion.
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
      std::ptrdiff_t        along_by, across_by; // change of a point's number per step

      std::size_t begin  = 0;  // number of its first point
      int         parent = -1; // level of the parent
      int         along  = 0;  // place of the first of the parent's points that it covers
      int         across = 0;

      // A window across the seam has two parts: one ends at the outlet, with the copy of
      // the seam, the other begins at the inlet, with the seam. The grid does both, other
      // windows neither.
      int  window          = -1;
      int  first           = 0; // column of the window, along the flow, where it begins
      bool begins_at_inlet = true;
      bool ends_at_outlet  = true;

      /** Number of outermost points on each side that serve interpolation only. */
      int
      rim() const
      {
        return window < 0 ? 0 : 1;
      }
    };

    /** A point, by its level, its column along the flow and its row across it. */
    struct Place
    {
      int level;
      int along;
      int across;
    };

    LatticeLevels(const SlabLayout &layout, const FlowDomain &domain);

    const bool along_x;     // whether the flow is along x
    const bool is_periodic; // across the flow

    // On the grid: number of points of a line; the lines that this rank knows,
    // first <= line < end, where −1 is the one before line 0; number of points on these,
    // which come before those of windows; of them, the points on lines that this rank
    // owns, first_own <= k < end_own.
    int         length;
    int         first = 0, end = 0;
    std::size_t n_on_grid = 0, first_own = 0, end_own = 0;

    /** Level 0 is the grid; the windows follow, each after its parent. */
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

    /** Number of points that this rank knows, on all levels. */
    std::size_t
    n_points() const
    {
      const Level &last = levels.back();
      return size() == 1
               ? n_on_grid
               : last.begin + static_cast<std::size_t>(last.n_along) * last.n_across;
    }

    /** The number that stands for no point. */
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /** The number of point @p i of line @p line; none if this rank does not know it. */
    std::size_t
    number_of(const int line, const int i) const
    {
      return line < first || line >= end || i < 0 || i >= length
               ? none
               : static_cast<std::size_t>(line - first) * length + i;
    }

    /** The line of point @p k of the grid, counted from the first that this rank knows. A
     *  division would take longer than a step of a search; half a point keeps the product
     *  that replaces it away from whole numbers. */
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

    /** The row @p across the flow of the grid, moved into the period if there is one. */
    int
    wrapped(const int across) const
    {
      const int n = levels.front().n_across;
      return !is_periodic ? across : ((across % n) + n) % n;
    }

    /** The place of point @p p on the finest level that has this point. */
    Place finest(const Place &p) const;

    /** Whether point @p p of a window coincides with a point of the parent that is on the
     *  rim of those that the window covers. */
    bool is_on_rim(const Place &p) const;

    /** The parent's point in whose cell point @p p of a window lies. */
    Place parent_of(const Place &p) const;

    /** The place of point @p p; on the seam, that at the inlet. */
    Place place(const GridPoint &p) const;

    /** The point of the grid or of a window at place @p p. */
    GridPoint point(const Place &p) const;

  private:
    void find_lines(const SlabLayout &layout);
    void add_window(const SlabLayout &layout, int w);

    /** The level that has column @p along of a window (−1: the grid). For a column on the
     *  seam, it is the one at the outlet if @p of_outlet, else the one at the inlet. */
    int level_with(int window, int along, bool of_outlet) const;

    double             lines_per_point;
    std::vector<Level> levels;
  };
} // namespace strait
