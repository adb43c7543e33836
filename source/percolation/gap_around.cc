// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/clusters.h>
#include <strait/percolation/gap_around.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strait
{
  GapAround::GapAround(const SlabField    &gap_,
                       const double        slip_length_,
                       const int           first_row_,
                       std::vector<double> rows_)
    : gap(gap_)
    , layout(gap_.layout())
    , slip_length(slip_length_)
    , first_row(first_row_)
    , rows(std::move(rows_))
  {
  }

  double
  GapAround::at(const int window, const int ix, const int iy)
  {
    if (window >= 0)
      return open_gap(
        gap[layout.start_of_window(window) +
            static_cast<std::size_t>(iy) * layout.windows()[window].n_columns() + ix],
        slip_length);
    const int         nx    = layout.grid().nx;
    const std::size_t place = static_cast<std::size_t>(iy - first_row) * nx;
    complete                = complete && iy >= first_row && place < rows.size();
    return complete ? open_gap(rows[place + ((ix % nx) + nx) % nx], slip_length)
                    : std::numeric_limits<double>::quiet_NaN();
  }

  int
  GapAround::window_at(const double x, const double y) const
  {
    int result = -1;
    for (int w = 0; w < static_cast<int>(layout.windows().size()); ++w)
      {
        const ZoomWindow &window = layout.windows()[w];
        const auto [a, b]        = indices(w, x, y);
        if ((result < 0 || window.level > layout.windows()[result].level) && a >= 1 &&
            a <= window.n_columns() - 2 && b >= 1 && b <= window.n_rows() - 2)
          result = w;
      }
    return result;
  }

  double
  GapAround::root_at(const double x, const double y, const bool open_only)
  {
    const int window  = window_at(x, y);
    const auto [a, b] = indices(window, x, y);
    const int ix = static_cast<int>(std::floor(a)), iy = static_cast<int>(std::floor(b));
    const double s = a - ix, t = b - iy;
    const Roots  cubic = interpolate(window, ix, iy, cubic_weights(s), cubic_weights(t));
    if (!cubic.between_closed)
      return cubic.value;
    const Roots bilinear =
      interpolate(window, ix, iy, {{0., 1 - s, s, 0.}}, {{0., 1 - t, t, 0.}});
    return open_only && bilinear.between_closed ? 0. : bilinear.value;
  }

  GapAround::Weights
  GapAround::cubic_weights(const double s)
  {
    return {{-s * (s - 1) * (s - 2) / 6,
             (s + 1) * (s - 1) * (s - 2) / 2,
             -(s + 1) * s * (s - 2) / 2,
             (s + 1) * s * (s - 1) / 6}};
  }

  GapAround::Roots
  GapAround::interpolate(const int      window,
                         const int      ix,
                         const int      iy,
                         const Weights &along_x,
                         const Weights &along_y)
  {
    Roots result;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        if (const double weight = along_x[i] * along_y[j]; weight != 0.)
          {
            const double g        = at(window, ix + i - 1, iy + j - 1);
            result.between_closed = result.between_closed || g <= 0;
            result.value += weight * std::pow(std::max(g, 0.), 2. / 3.);
          }
    return result;
  }

  std::array<double, 2>
  GapAround::indices(const int window, const double x, const double y) const
  {
    const auto [x0, y0]          = layout.position(window, 0, 0);
    const auto [dx, dy]          = layout.spacing(window);
    const PeriodicGrid   &grid   = layout.grid();
    std::array<double, 2> result = {{(x - x0) / dx, (y - y0) / dy}};
    if (window >= 0)
      {
        result[0] -= std::floor((x - x0) / grid.lx + 1e-9) * grid.lx / dx;
        result[1] -= std::floor((y - y0) / grid.ly + 1e-9) * grid.ly / dy;
      }
    for (double &index : result)
      if (std::abs(index - std::round(index)) < 1e-6)
        index = std::round(index);
    return result;
  }
} // namespace strait
