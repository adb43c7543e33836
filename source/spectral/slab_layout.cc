// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/slab_layout.h>

#include <cmath>

namespace strait
{
  SlabLayout::SlabLayout(const PeriodicGrid     &grid,
                         MPI_Comm                communicator,
                         std::vector<ZoomWindow> windows)
    : periodic_grid(grid)
    , comm(communicator)
    , my_rank(rank_in(communicator))
    , number_of_ranks(n_ranks_in(communicator))
    , most_rows_per_rank((grid.ny + number_of_ranks - 1) / number_of_ranks)
    , zoom_windows(std::move(windows))
  {
    starts_of_windows.push_back(n_local_points());
    if (zoom_windows.empty())
      own_ranges.push_back({0, n_local_points(), 1.});
    else
      for (int row = 0; row < n_rows(); ++row)
        add_ranges_of_row(-1,
                          first_row() + row,
                          static_cast<std::size_t>(row) * grid.nx,
                          1.);
    for (std::size_t w = 0; w < zoom_windows.size(); ++w)
      {
        const ZoomWindow &window = zoom_windows[w];
        const std::size_t begin  = starts_of_windows.back();
        const double      area   = std::pow(9., -window.level) / number_of_ranks;
        for (int row = 0; row < window.n_rows(); ++row)
          add_ranges_of_row(static_cast<int>(w),
                            row,
                            begin + static_cast<std::size_t>(row) * window.n_columns(),
                            area);
        starts_of_windows.push_back(begin + static_cast<std::size_t>(window.n_rows()) *
                                              window.n_columns());
      }
  }

  void
  SlabLayout::add_ranges_of_row(const int         window,
                                const int         row,
                                const std::size_t begin,
                                const double      area)
  {
    const int n  = window < 0 ? periodic_grid.nx : zoom_windows[window].n_columns();
    int       ix = 0;
    while (ix < n)
      {
        while (ix < n && finer({ix, row, window}))
          ++ix;
        const int first = ix;
        while (ix < n && !finer({ix, row, window}))
          ++ix;
        if (ix > first)
          own_ranges.push_back({begin + first, begin + ix, area});
      }
  }

  std::optional<GridPoint>
  SlabLayout::finer(const GridPoint &point) const
  {
    for (int w = 0; w < static_cast<int>(zoom_windows.size()); ++w)
      {
        const ZoomWindow &window = zoom_windows[w];
        if (window.parent != point.window)
          continue;
        int a = point.ix - window.x, b = point.iy - window.y;
        if (point.window < 0)
          {
            a = (a + periodic_grid.nx) % periodic_grid.nx;
            b = (b + periodic_grid.ny) % periodic_grid.ny;
          }
        if (a >= 0 && a < window.nx && b >= 0 && b < window.ny)
          return GridPoint{3 * a + 1, 3 * b + 1, w};
      }
    return {};
  }

  int
  SlabLayout::seam(const int w, const int axis) const
  {
    const ZoomWindow &window = zoom_windows[w];
    const int         first  = axis == 0 ? window.x : window.y;
    const int         n      = axis == 0 ? window.nx : window.ny;
    int               covered;
    if (window.parent >= 0)
      {
        const int of_parent = seam(window.parent, axis);
        covered             = of_parent < 0 ? -1 : of_parent - first;
      }
    else
      {
        const int n_grid = axis == 0 ? periodic_grid.nx : periodic_grid.ny;
        covered          = (n_grid - first % n_grid) % n_grid;
      }
    return covered >= 0 && covered < n ? 3 * covered + 1 : -1;
  }

  std::array<double, 2>
  SlabLayout::spacing(const int w) const
  {
    const double factor = w < 0 ? 1. : std::pow(3., -zoom_windows[w].level);
    return {periodic_grid.dx() * factor, periodic_grid.dy() * factor};
  }

  std::array<double, 2>
  SlabLayout::position(const int w, const int ix, const int iy) const
  {
    const auto [dx, dy] = spacing(w);
    if (w < 0)
      return {ix * dx, iy * dy};
    const ZoomWindow &window = zoom_windows[w];
    const auto [x, y]        = position(window.parent, window.x, window.y);
    return {x + (ix - 1) * dx, y + (iy - 1) * dy};
  }

  SlabLayoutPtr
  make_layout(const PeriodicGrid &grid, MPI_Comm communicator)
  {
    return std::make_shared<const SlabLayout>(grid, communicator);
  }

  SlabLayoutPtr
  with_windows(const SlabLayout &layout, std::vector<ZoomWindow> windows)
  {
    return std::make_shared<const SlabLayout>(layout.grid(),
                                              layout.communicator(),
                                              std::move(windows));
  }
} // namespace strait
