// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_levels.h>

#include <algorithm>

namespace strait
{
  GapLevels::GapLevels(SlabLayoutPtr layout)
    : slab_layout(std::move(layout))
  {
  }

  void
  GapLevels::update(const SlabField &gap)
  {
    slab_layout = gap.layout_pointer();
    std::vector<int> wanted;
    const int        begin = slab_layout->first_row(), n_rows = slab_layout->n_rows();
    if (n_rows > 0)
      for (int row = begin - 1; row < begin + n_rows + 3; ++row)
        wanted.push_back(row);
    grid_rows = fetch_rows(gap, wanted);
    window_values.assign(gap.begin() +
                           static_cast<std::ptrdiff_t>(slab_layout->n_local_points()),
                         gap.end());
  }

  std::optional<LevelCell>
  GapLevels::first_finer_cell(const LevelCell &cell) const
  {
    const int w = slab_layout->covered_by(cell.window, cell.ix, cell.iy);
    if (w < 0)
      return {};
    const ZoomWindow &window = slab_layout->windows()[w];
    int               a = cell.ix - window.x, b = cell.iy - window.y;
    if (cell.window < 0)
      {
        const PeriodicGrid &grid = slab_layout->grid();
        a                        = (a + grid.nx) % grid.nx;
        b                        = (b + grid.ny) % grid.ny;
      }
    if (a + 1 == window.nx || b + 1 == window.ny)
      return {};
    return LevelCell{w, 3 * a + 1, 3 * b + 1};
  }

  GapStencil
  GapLevels::stencil(const LevelCell &cell) const
  {
    GapStencil gap;
    if (cell.window < 0)
      {
        const int nx  = slab_layout->grid().nx;
        const int row = cell.iy - slab_layout->first_row();
        for (int b = 0; b < 4; ++b)
          {
            const double *line =
              grid_rows.data() + static_cast<std::size_t>(row + b) * nx;
            for (int a = 0; a < 4; ++a)
              gap[b][a] = line[(cell.ix + a - 1 + nx) % nx];
          }
      }
    else
      for (int b = 0; b < 4; ++b)
        std::copy_n(window_values.data() +
                      position({cell.window, cell.ix - 1, cell.iy - 1 + b}),
                    4,
                    gap[b].begin());
    return gap;
  }

  GapRows
  GapLevels::rows(const GapInterpolant &interpolant,
                  const double          y_low,
                  const double          y_high) const
  {
    const PeriodicGrid &grid  = slab_layout->grid();
    int                 first = 0;
    std::vector<int>    wanted;
    if (y_low <= y_high) // else this rank has no cells
      {
        const double dy = grid.dy();
        first           = std::clamp(static_cast<int>(y_low / dy), 0, grid.ny - 1) - 1;
        const int last  = std::min(static_cast<int>(y_high / dy), grid.ny - 1) + 2;
        for (int row = first; row <= last; ++row)
          wanted.push_back(row);
      }
    // The rows of this rank follow the one before them.
    const double *own_rows = grid_rows.data() + (grid_rows.empty() ? 0 : grid.nx);
    return {grid,
            interpolant,
            first,
            fetch_rows(*slab_layout, own_rows, grid.nx, wanted)};
  }
} // namespace strait
