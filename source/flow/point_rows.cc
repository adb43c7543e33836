// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/point_rows.h>

#include <cmath>

namespace strait
{
  PointRows
  rows_of_grid(const PeriodicGrid &grid, const int stride)
  {
    return {0.,
            0.,
            static_cast<double>(stride),
            (grid.nx + stride - 1) / stride,
            (grid.ny + stride - 1) / stride};
  }

  PointRows
  rows_of_window(const SlabLayout &layout, const int window)
  {
    const auto [x, y]    = layout.position(window, 0, 0);
    const ZoomWindow &of = layout.windows()[window];
    return {x / layout.grid().dx(),
            y / layout.grid().dy(),
            std::pow(3., -of.level),
            of.n_columns(),
            of.n_rows()};
  }
} // namespace strait
