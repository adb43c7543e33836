// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_window.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  GapWindow::GapWindow(const PeriodicGrid   &grid_,
                       const GapInterpolant &interpolant_,
                       const int             first_row_,
                       std::vector<double>   rows_)
    : grid(grid_)
    , interpolant(interpolant_)
    , first_row(first_row_)
    , rows(std::move(rows_))
  {
  }

  double
  GapWindow::operator()(const double x, const double y) const
  {
    const double s = x / grid.dx(), t = y / grid.dy();
    const int    n_rows = static_cast<int>(rows.size()) / grid.nx;
    const int    ix     = std::clamp(static_cast<int>(std::floor(s)), 0, grid.nx - 1);
    const int    row =
      std::clamp(static_cast<int>(std::floor(t)) - first_row, 1, n_rows - 3);
    GapStencil gap;
    for (int b = 0; b < 4; ++b)
      {
        const double *line =
          rows.data() + static_cast<std::size_t>(row - 1 + b) * grid.nx;
        for (int a = 0; a < 4; ++a)
          gap[b][a] = line[(ix + a - 1 + grid.nx) % grid.nx];
      }
    if (!GapInterpolant::may_be_open(gap))
      return 0.;
    const double in_x   = std::clamp(s - ix, 0., 1.);
    const double in_y   = std::clamp(t - (first_row + row), 0., 1.);
    double       result = 0.;
    interpolant.evaluate(gap, 1, &in_x, &in_y, &result);
    return result;
  }
} // namespace strait
