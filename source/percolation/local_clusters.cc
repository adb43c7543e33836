// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/local_clusters.h>

namespace strait
{
  std::vector<int>
  covering_windows(const SlabLayout &layout, const int parent, const int row)
  {
    const std::vector<ZoomWindow> &windows = layout.windows();
    std::vector<int> result(parent < 0 ? layout.grid().nx : windows[parent].n_columns(),
                            -1);
    const auto n = static_cast<int>(result.size());
    for (std::size_t w = 0; w < windows.size(); ++w)
      {
        const ZoomWindow &window = windows[w];
        if (window.parent != parent)
          continue;
        const int ny = layout.grid().ny;
        const int b  = parent < 0 ? (row - window.y + ny) % ny : row - window.y;
        if (b >= 0 && b < window.ny)
          for (int a = 0; a < window.nx; ++a)
            result[(window.x + a + n) % n] = static_cast<int>(w);
      }
    return result;
  }

  namespace
  {
    /** Points of one level, row by row. */
    struct PointRows
    {
      int         window; // −1: the grid
      std::size_t begin;  // position of the first value
      int         n_columns;
      int         n_rows;
      int         rim;                // width of the rim of points that have no edges
      int         closed_column = -1; // no edge leads there from the one before
      int         closed_row    = -1;
    };

    /** Join the open neighbours among @p points. */
    void
    join_neighbours(const SlabField &gap, const PointRows &points, DisjointSets &sets)
    {
      const SlabLayout &layout = gap.layout();
      std::vector<int>  below(points.n_columns, -1), here(below);
      for (int row = points.rim; row < points.n_rows - points.rim; ++row)
        {
          if (!layout.windows().empty())
            {
              const int number = (points.window < 0 ? layout.first_row() : 0) + row;
              below.swap(here);
              here = covering_windows(layout, points.window, number);
            }
          const std::size_t first =
            points.begin + static_cast<std::size_t>(row) * points.n_columns;
          for (int ix = points.rim; ix < points.n_columns - points.rim; ++ix)
            {
              const std::size_t k = first + ix;
              if (!(gap[k] > 0))
                continue;
              if (ix > points.rim && ix != points.closed_column && gap[k - 1] > 0 &&
                  !is_refined(here[ix], here[ix - 1]))
                sets.join(k, k - 1);
              if (row > points.rim && row != points.closed_row &&
                  gap[k - points.n_columns] > 0 && !is_refined(here[ix], below[ix]))
                sets.join(k, k - points.n_columns);
            }
        }
    }

    /** Join the open points of the windows with each other. */
    void
    join_in_windows(const SlabField    &gap,
                    const FlowDirection direction,
                    DisjointSets       &sets)
    {
      const SlabLayout &layout    = gap.layout();
      const auto        join_open = [&](const std::size_t a, const std::size_t b) {
        if (gap[a] > 0 && gap[b] > 0)
          sets.join(a, b);
      };
      for (int w = 0; w < static_cast<int>(layout.windows().size()); ++w)
        {
          const ZoomWindow &window    = layout.windows()[w];
          const int         n_columns = window.n_columns(), n_rows = window.n_rows();
          PointRows         points{w, layout.start_of_window(w), n_columns, n_rows, 1};
          if (direction == FlowDirection::x)
            points.closed_column = layout.seam(w, 0);
          else
            points.closed_row = layout.seam(w, 1);
          join_neighbours(gap, points, sets);
          // The outermost points follow those inside of them.
          const auto follow = [&](const int ix, const int iy) {
            const auto at = [&](const int column, const int row) {
              return points.begin + static_cast<std::size_t>(row) * n_columns + column;
            };
            join_open(at(ix, iy),
                      at(std::clamp(ix, 1, n_columns - 2),
                         std::clamp(iy, 1, n_rows - 2)));
          };
          for (int ix = 0; ix < n_columns; ++ix)
            for (const int iy : {0, n_rows - 1})
              follow(ix, iy);
          for (int iy = 1; iy < n_rows - 1; ++iy)
            for (const int ix : {0, n_columns - 1})
              follow(ix, iy);
          if (window.parent >= 0)
            layout.for_each_covered(w, join_open);
        }
    }
  } // namespace

  DisjointSets
  join_open_points(const SlabField &gap, const FlowDirection direction)
  {
    const SlabLayout &layout = gap.layout();
    const int         nx = gap.grid().nx, n_rows = layout.n_rows();
    DisjointSets      sets(gap.size());
    join_neighbours(gap, {-1, 0, nx, n_rows, 0}, sets);
    // The seam is closed across the flow only.
    if (direction == FlowDirection::y)
      for (int row = 0; row < n_rows; ++row)
        if (gap(0, row) > 0 && gap(nx - 1, row) > 0)
          {
            const int number = layout.first_row() + row;
            if (!is_refined(layout.covered_by(-1, 0, number),
                            layout.covered_by(-1, nx - 1, number)))
              {
                const std::size_t first = static_cast<std::size_t>(row) * nx;
                sets.join(first, first + nx - 1);
              }
          }
    join_in_windows(gap, direction, sets);
    return sets;
  }

  std::vector<SeamPoint>
  seam_points(const SlabLayout &layout, const FlowDirection direction)
  {
    std::vector<SeamPoint> points;
    const int              axis = direction == FlowDirection::x ? 0 : 1;
    for (int w = 0; w < static_cast<int>(layout.windows().size()); ++w)
      {
        const ZoomWindow &window = layout.windows()[w];
        const int         seam   = layout.seam(w, axis);
        const int         n      = axis == 0 ? window.n_rows() : window.n_columns();
        for (int across = 1; seam >= 0 && across < n - 1; ++across)
          {
            const auto at = [&](const int along) {
              const int ix = axis == 0 ? along : across, iy = axis == 0 ? across : along;
              return layout.start_of_window(w) +
                     static_cast<std::size_t>(iy) * window.n_columns() + ix;
            };
            const auto cover = [&](const int along) {
              return axis == 0 ? layout.covered_by(w, along, across)
                               : layout.covered_by(w, across, along);
            };
            points.push_back({at(seam), {}});
            // The outermost points of a window have no edges.
            if (seam > 1 && !is_refined(cover(seam), cover(seam - 1)))
              points.back().behind = at(seam - 1);
          }
      }
    return points;
  }
} // namespace strait
