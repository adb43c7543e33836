// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/grid_transfer.h>
#include <strait/contact/window_transfer.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace strait
{
  namespace
  {
    /** Fill window @p w of @p pressure from the parent: interpolated, and 0 where the
     *  nearest point of the parent does not touch. Collective. */
    void
    fill_from_parent(SlabField &pressure, const int w)
    {
      const SlabLayout         &layout = pressure.layout();
      const ZoomWindow         &window = layout.windows()[w];
      WindowTransfer<double>    transfer(window);
      const std::vector<double> patch = transfer.patch_of(layout, w, pressure.data());
      double                   *value = pressure.data() + layout.start_of_window(w);
      transfer.interpolate(patch, value);
      for (int iy = 0; iy < window.n_rows(); ++iy)
        for (int ix = 0; ix < window.n_columns(); ++ix, ++value)
          {
            const int nearest = (iy / 3 + ZoomWindow::margin) * transfer.patch_columns() +
                                ix / 3 + ZoomWindow::margin;
            const bool touches = patch[nearest] > 0;
            *value             = touches ? std::max(*value, 0.) : 0.;
          }
    }

    /** Return the number of the window of @p layout that is the same as window @p w of
     *  @p other, or −1. */
    int
    find_window(const SlabLayout &layout, const SlabLayout &other, const int w)
    {
      const ZoomWindow &wanted = other.windows()[w];
      for (std::size_t k = 0; k < layout.windows().size(); ++k)
        {
          const ZoomWindow &window = layout.windows()[k];
          if (window.level == wanted.level && window.nx == wanted.nx &&
              window.ny == wanted.ny &&
              layout.position(static_cast<int>(k), 0, 0) == other.position(w, 0, 0))
            return static_cast<int>(k);
        }
      return -1;
    }

    /** Return @p field with @p windows in place of its own. Windows that it has already
     *  are kept, the others filled by @p fill(result, window) from their parents.
     *  Collective. */
    template <class Fill>
    SlabField
    with_new_windows(const SlabField        &field,
                     std::vector<ZoomWindow> windows,
                     const Fill             &fill)
    {
      const SlabLayout   &old    = field.layout();
      const SlabLayoutPtr layout = with_windows(old, std::move(windows));
      SlabField           result(layout);
      std::copy_n(field.begin(), layout->n_local_points(), result.begin());
      for (int w = 0; w < static_cast<int>(layout->windows().size()); ++w)
        if (const int known = find_window(old, *layout, w); known >= 0)
          std::copy(field.data() + old.start_of_window(known),
                    field.data() + old.start_of_window(known + 1),
                    result.data() + layout->start_of_window(w));
        else
          fill(result, w);
      return result;
    }
  } // namespace

  bool
  can_be_coarsened(const PeriodicGrid &grid)
  {
    return grid.nx % 2 == 0 && grid.ny % 2 == 0 && grid.nx >= 64 && grid.ny >= 64;
  }

  SlabField
  restrict_by_injection(const SlabField &fine)
  {
    const PeriodicGrid &g = fine.grid();
    SlabField           coarse(
      make_layout({g.nx / 2, g.ny / 2, g.lx, g.ly}, fine.layout().communicator()));
    const SlabLayout &layout = coarse.layout();

    std::vector<int> wanted(layout.n_rows());
    for (int row = 0; row < layout.n_rows(); ++row)
      wanted[row] = 2 * (layout.first_row() + row);
    const std::vector<double> rows = fetch_rows(fine, wanted);
    for (int row = 0; row < layout.n_rows(); ++row)
      for (int ix = 0; ix < g.nx / 2; ++ix)
        coarse(ix, row) = rows[static_cast<std::size_t>(row) * g.nx + 2 * ix];
    return coarse;
  }

  SlabField
  prolong_bilinearly(const SlabField &coarse, const SlabLayoutPtr &fine_layout)
  {
    SlabField fine(fine_layout);
    const int n = coarse.grid().nx, n_rows = fine_layout->n_rows();
    const int first = fine_layout->first_row() / 2;

    // All coarse rows on which or between which the local rows lie.
    std::vector<int> wanted;
    if (n_rows > 0)
      wanted.resize((fine_layout->first_row() + n_rows) / 2 - first + 1);
    std::iota(wanted.begin(), wanted.end(), first);
    const std::vector<double> rows = fetch_rows(coarse, wanted);

    for (int row = 0; row < n_rows; ++row)
      {
        const int     iy    = fine_layout->first_row() + row;
        const double *lower = rows.data() + static_cast<std::size_t>(iy / 2 - first) * n;
        const double *upper = iy % 2 == 0 ? lower : lower + n;
        for (int ix = 0; ix < n; ++ix)
          {
            const int    next     = ix + 1 < n ? ix + 1 : 0;
            const double here     = 0.5 * (lower[ix] + upper[ix]);
            fine(2 * ix, row)     = here;
            fine(2 * ix + 1, row) = 0.5 * (here + 0.5 * (lower[next] + upper[next]));
          }
      }
    return fine;
  }

  SlabField
  zoom_in(const SlabField &pressure, std::vector<ZoomWindow> windows)
  {
    return with_new_windows(pressure, std::move(windows), fill_from_parent);
  }

  SlabField
  zoom_in_linearly(const SlabField &field, std::vector<ZoomWindow> windows)
  {
    return with_new_windows(field,
                            std::move(windows),
                            [](SlabField &result, const int w) {
                              const std::vector<double> around = around_window(result, w);
                              const int nx = result.layout().windows()[w].n_columns();
                              const int ny = result.layout().windows()[w].n_rows();
                              double   *row =
                                result.data() + result.layout().start_of_window(w);
                              for (int iy = 1; iy <= ny; ++iy, row += nx)
                                std::copy_n(around.data() + iy * (nx + 2) + 1, nx, row);
                            });
  }

  std::vector<double>
  around_window(const SlabField &field, const int w)
  {
    const ZoomWindow            &window = field.layout().windows()[w];
    const WindowTransfer<double> transfer(window);
    const std::vector<double> patch = transfer.patch_of(field.layout(), w, field.data());
    // For a column or row of the window: the last one of the patch at or before it, and
    // the distance from there in spacings of the parent.
    const auto place = [](const int fine) {
      constexpr int shift = 3 * ZoomWindow::margin - 1; // so that the sum is above 0
      return std::pair((fine + shift) / 3, (fine + shift) % 3 / 3.);
    };
    std::vector<double> around;
    for (int iy = -1; iy <= window.n_rows(); ++iy)
      for (int ix = -1; ix <= window.n_columns(); ++ix)
        {
          const auto [column, s] = place(ix);
          const auto [row, t]    = place(iy);
          const double *here     = patch.data() + row * transfer.patch_columns() + column;
          const double *above    = here + transfer.patch_columns();
          around.push_back((1. - t) * ((1. - s) * here[0] + s * here[1]) +
                           t * ((1. - s) * above[0] + s * above[1]));
        }
    return around;
  }
} // namespace strait
