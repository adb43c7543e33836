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
   * A rectangle in which a field is also known on points that lie three times as densely
   * each way as those of its parent, the periodic grid or another window. It covers
   * nx × ny points of the parent, and tiles what these stand for: it has 3 nx × 3 ny
   * points, of which point (3 a + 1, 3 b + 1) is point (x + a, y + b) of the parent.
   *
   * A window of the grid may cross the periodic seam; one of a window lies inside of it
   * with at least `margin` points to spare on all sides. Windows of one parent do not
   * overlap, and have at least one point of the parent between them.
   */
  struct ZoomWindow
  {
    /** The parent's points that an interpolation into the window needs around it. Half of
     *  it shifts the critical load of the square saddle, refined threefold from 128
     *  points, by 3e-5, double of it asks more of the parent without need. */
    static constexpr int margin = 4;

    int parent = -1; // number of the window in which it lies; −1: the grid
    int level  = 1;  // how often the grid's spacing was divided by three
    int x      = 0;  // column of the first of the parent's points that it covers
    int y      = 0;  // row of the same
    int nx     = 0;  // how many of the parent's columns it covers
    int ny     = 0;  // how many of the rows

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

  /**
   * How the rows (constant y) of a periodic grid are dealt out to the ranks:
   * contiguous blocks that ascend with the rank, all of the same number of rows but
   * the last ones, which have fewer or none. There may be windows of finer points as
   * well, which all ranks hold.
   */
  class SlabLayout
  {
  public:
    /** Windows come after their parents. */
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

    /** First row of this rank, and how many it has. */
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

    /** First row of @p rank; of the number of ranks, the number of rows. */
    int
    first_row_of(const int rank) const
    {
      return std::min(rank * n_rows_most, periodic_grid.ny);
    }

    /** The rank that owns row @p row, 0 <= row < ny. */
    int
    owner_of_row(const int row) const
    {
      return row / n_rows_most;
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

    /** Position of the first value of window @p w among those of this rank; for the
     *  number of windows, n_values(). */
    std::size_t
    start_of_window(const int w) const
    {
      return starts_of_windows[w];
    }

    /** Where among the values of this rank that at @p point is, whose column and row
     *  count modulo those of the grid; n_values() if it is another rank's. */
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

    /** Call visit(point) for the points of the values of this rank, in their order. */
    template <class Visit>
    void for_each_point(const Visit &visit) const;

    /** Spacing of the points of window @p w, −1 for the grid, in x and y. */
    std::array<double, 2> spacing(int w) const;

    /** Where point (@p ix, @p iy) of window @p w, −1 for the grid, lies; within the box
     *  unless the window crosses the seam. */
    std::array<double, 2> position(int w, int ix, int iy) const;

    /** Call visit(a, b, k) for the points of its parent that window @p w covers, and for
     *  @p margin more on all sides: column and row, counted from the first one that is
     *  covered, and the position of its value. Of the grid, those of this rank. */
    template <class Visit>
    void for_each_around(int w, int margin, const Visit &visit) const;

    /** Call visit(k_parent, k_window) with the positions of the values of both for each
     *  point of this rank that a window covers, of each window before its parent's. */
    template <class Visit>
    void for_each_covered(const Visit &visit) const;

    /** The point of a window that is the same as @p point, if one covers that. */
    std::optional<GridPoint> finer(const GridPoint &point) const;

    /** The column (@p axis 0) or row (1) of window @p w on the first one of the grid,
     * where the seam is; −1 if it covers no point there. */
    int seam(int w, int axis) const;

    /** A range of values at points that no finer ones cover: begin <= k < end. */
    struct Range
    {
      std::size_t begin;
      std::size_t end;
      double      area; // that a point stands for here, over that of a grid point
    };

    /**
     * The ranges that together stand for the whole box, once over all ranks: of a window,
     * which all ranks hold, each stands for its share of the area.
     */
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
    int                      n_rows_most; // that a rank has
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
