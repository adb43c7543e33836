// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/periodic_grid.h>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace strait
{
  /**
   * A rectangle in which a field is also known at finer points, three times as dense in
   * each direction as those of its parent, which is the periodic grid or another window.
   * It covers nx × ny points of the parent and has 3 nx × 3 ny points, which fill the
   * area that those stand for: point (3 a + 1, 3 b + 1) is point (x + a, y + b) of the
   * parent.
   *
   * A window in the grid may cross the periodic seam; one in a window keeps at least
   * `margin` of the parent's points from each side. Windows of one parent do not overlap,
   * and have at least one point of the parent between them.
   */
  struct ZoomWindow
  {
    /** Number of the parent's points around the window that interpolation into it needs.
     *  Half of it shifts the critical load of the square saddle, refined threefold from
     *  128 points, by 3e-5; double of it asks more of the parent without need. */
    static constexpr int margin = 4;

    int parent = -1; // number of the window in which it lies; −1: the grid
    int level  = 1;  // how often the grid's spacing was divided by three
    int x      = 0;  // column of the first of the parent's points that it covers
    int y      = 0;  // row of that point
    int nx     = 0;  // how many of the parent's columns it covers
    int ny     = 0;  // how many of the parent's rows

    int
    n_columns() const
    {
      return 3 * nx;
    }

    int
    n_rows() const
    {
      return 3 * ny;
    }

    bool
    operator==(const ZoomWindow &other) const
    {
      return parent == other.parent && level == other.level && x == other.x &&
             y == other.y && nx == other.nx && ny == other.ny;
    }
  };

  /** The distribution of the rows (constant y) of a periodic grid among the ranks:
   *  contiguous blocks in the order of the ranks, all with the same number of rows except
   *  the last ones, which have fewer or none. All ranks hold the windows of finer points,
   *  if there are any. */
  class SlabLayout
  {
  public:
    /** Each of the @p windows comes after its parent. */
    SlabLayout(const PeriodicGrid     &grid,
               MPI_Comm                communicator,
               std::vector<ZoomWindow> windows = {});

    const PeriodicGrid &
    grid() const
    {
      return periodic_grid;
    }

    MPI_Comm
    communicator() const
    {
      return comm;
    }

    int
    rank() const
    {
      return my_rank;
    }

    int
    n_ranks() const
    {
      return number_of_ranks;
    }

    /** First row of this rank, and its number of rows. */
    int
    first_row() const
    {
      return first_row_of(my_rank);
    }

    int
    n_rows() const
    {
      return first_row_of(my_rank + 1) - first_row_of(my_rank);
    }

    /** First row of @p rank; ny if @p rank is n_ranks(). */
    int
    first_row_of(const int rank) const
    {
      return std::min(rank * most_rows_per_rank, periodic_grid.ny);
    }

    /** The rank that owns row @p row, 0 <= row < ny. */
    int
    owner_of_row(const int row) const
    {
      return row / most_rows_per_rank;
    }

    /** Number of grid points of this rank, without windows. */
    std::size_t
    n_local_points() const
    {
      return static_cast<std::size_t>(n_rows()) * periodic_grid.nx;
    }

    /** The windows of finer points, each after its parent. */
    const std::vector<ZoomWindow> &
    windows() const
    {
      return zoom_windows;
    }

    /** Number of values of a field on this rank: those at its grid points, then those of
     *  each window, row by row. */
    std::size_t
    n_values() const
    {
      return starts_of_windows.back();
    }

    /** Position of the first value of window @p w among those of this rank; n_values() if
     *  @p w is the number of windows. */
    std::size_t
    start_of_window(const int w) const
    {
      return starts_of_windows[w];
    }

    /** Position of the value at @p point among those of this rank, or n_values() if
     *  another rank owns it. Column and row of a grid point count modulo nx and ny. */
    std::size_t
    index_of(const GridPoint &point) const
    {
      if (point.window >= 0)
        return start_of_window(point.window) +
               static_cast<std::size_t>(point.iy) *
                 zoom_windows[point.window].n_columns() +
               point.ix;
      const int row = point.iy % periodic_grid.ny - first_row();
      return row < 0 || row >= n_rows()
               ? n_values()
               : static_cast<std::size_t>(row) * periodic_grid.nx +
                   point.ix % periodic_grid.nx;
    }

    /** Call visit(point) for the points of this rank, in the order of their values. */
    template <class Visit>
    void for_each_point(const Visit &visit) const;

    /** Spacing in x and y of the points of window @p w; −1: of the grid. */
    std::array<double, 2> spacing(int w) const;

    /** Where point (@p ix, @p iy) of window @p w (−1: of the grid) lies: within the box,
     *  unless the window crosses the seam. */
    std::array<double, 2> position(int w, int ix, int iy) const;

    /** Call visit(a, b, k) for the points of the parent that window @p w covers, and
     *  @p margin more on each side. Column a and row b count from the first point that is
     *  covered; k is the position of the value. On the grid, only points of this rank are
     *  visited. */
    template <class Visit>
    void for_each_around(int w, int margin, const Visit &visit) const;

    /** Call visit(k_parent, k_window) for each point of this rank that a window covers,
     *  with the positions of its values in the parent and in the window. Each window
     *  comes before its parent. */
    template <class Visit>
    void for_each_covered(const Visit &visit) const;

    /** The point of a window that coincides with @p point, if a window covers it. */
    std::optional<GridPoint> finer(const GridPoint &point) const;

    /** The column (@p axis 0) or row (1) of window @p w that lies on the grid's first
     *  one, where the seam is; −1 if the window covers no point there. */
    int seam(int w, int axis) const;

    /** A range of values, begin <= k < end, at points that no window covers. */
    struct Range
    {
      std::size_t begin;
      std::size_t end;
      double      area; // that each point stands for, over that of a grid point
    };

    /** The ranges that, over all ranks, stand for the whole box exactly once. All ranks
     *  hold the windows, so the area of a window's points is divided among them. */
    const std::vector<Range> &
    ranges() const
    {
      return own_ranges;
    }

  private:
    void add_ranges_of_row(int window, int row, std::size_t begin, double area);

    PeriodicGrid             periodic_grid;
    MPI_Comm                 comm;
    int                      my_rank;
    int                      number_of_ranks;
    int                      most_rows_per_rank; // the most rows that a rank has
    std::vector<ZoomWindow>  zoom_windows;
    std::vector<std::size_t> starts_of_windows;
    std::vector<Range>       own_ranges;
  };

  template <class Visit>
  void
  SlabLayout::for_each_point(const Visit &visit) const
  {
    const auto visit_all =
      [&visit](const int w, const int nx, const int begin, const int end) {
        for (int iy = begin; iy < end; ++iy)
          for (int ix = 0; ix < nx; ++ix)
            visit(GridPoint{ix, iy, w});
      };
    visit_all(-1, periodic_grid.nx, first_row(), first_row() + n_rows());
    for (int w = 0; w < static_cast<int>(zoom_windows.size()); ++w)
      visit_all(w, zoom_windows[w].n_columns(), 0, zoom_windows[w].n_rows());
  }

  template <class Visit>
  void
  SlabLayout::for_each_around(const int w, const int margin, const Visit &visit) const
  {
    const ZoomWindow &window  = zoom_windows[w];
    const bool        on_grid = window.parent < 0;
    const int         nx = periodic_grid.nx, ny = periodic_grid.ny;
    for (int b = -margin; b < window.ny + margin; ++b)
      {
        const int row = on_grid ? (window.y + b + ny) % ny - first_row() : window.y + b;
        if (on_grid && (row < 0 || row >= n_rows()))
          continue;
        const std::size_t begin = on_grid ? static_cast<std::size_t>(row) * nx
                                          : starts_of_windows[window.parent] +
                                              static_cast<std::size_t>(row) *
                                                zoom_windows[window.parent].n_columns();
        for (int a = -margin; a < window.nx + margin; ++a)
          visit(a, b, begin + (on_grid ? (window.x + a + nx) % nx : window.x + a));
      }
  }

  template <class Visit>
  void
  SlabLayout::for_each_covered(const Visit &visit) const
  {
    for (int w = static_cast<int>(zoom_windows.size()) - 1; w >= 0; --w)
      for_each_around(w, 0, [&](const int a, const int b, const std::size_t k) {
        visit(k, index_of({3 * a + 1, 3 * b + 1, w}));
      });
  }

  /** Layouts are shared by the fields that use them. */
  using SlabLayoutPtr = std::shared_ptr<const SlabLayout>;

  /** The layout of @p grid on the ranks of @p communicator. */
  SlabLayoutPtr make_layout(const PeriodicGrid &grid, MPI_Comm communicator);

  /** The layout of the grid of @p layout with @p windows in place of its own. */
  SlabLayoutPtr with_windows(const SlabLayout &layout, std::vector<ZoomWindow> windows);
} // namespace strait
