// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/grid_lines.h>

#include <algorithm>

namespace strait
{
  GridLines::GridLines(SlabLayoutPtr layout_, const FlowDomain &domain)
    : layout(std::move(layout_))
    , region(domain.region)
  {
    const int  nx = layout->grid().nx, ny = layout->grid().ny;
    const bool along_x = region != nullptr || domain.direction == FlowDirection::x;
    n_along_line       = nx + (along_x ? 1 : 0);
    blocks_per_line    = (n_along_line + block_size - 1) / block_size;
    if (region != nullptr)
      {
        n_lines = layout->rank() == 0 ? ny + 1 : 0;
        own     = {{0, size()}};
        return;
      }
    const int first = layout->first_row(), n_rows = layout->n_rows();
    if (n_rows == 0)
      return;
    // Of a flow along y the outlet's copy of the first line follows the last one.
    const bool has_copy   = !along_x && first + n_rows == ny;
    const bool has_before = along_x || first > 0;
    const bool has_after  = along_x || first + n_rows < ny;
    const int  n_own      = n_rows + (has_copy ? 1 : 0);
    first_line            = first - (has_before ? 1 : 0);
    n_lines               = n_own + (has_before ? 1 : 0) + (has_after ? 1 : 0);
    own[0]                = has_before ? n_along_line : 0;
    own[1]                = own[0] + static_cast<std::size_t>(n_own) * n_along_line;
  }

  std::vector<double>
  GridLines::values(const SlabField &field) const
  {
    const int           nx = field.grid().nx, ny = field.grid().ny;
    std::vector<double> result(size(), 0.);
    if (region != nullptr)
      {
        const std::vector<double> whole = gather_on_root(field);
        for (std::size_t k = 0; k < result.size(); ++k)
          if (region->is_point(k))
            result[k] =
              whole[static_cast<std::size_t>(line_of(k) % ny) * nx + position_of(k) % nx];
        return result;
      }
    const int n_rows = layout->n_rows();
    for (int row = 0; row < n_rows; ++row)
      {
        double *line = &result[own[0] + static_cast<std::size_t>(row) * n_along_line];
        std::copy_n(field.data() + static_cast<std::size_t>(row) * nx, nx, line);
        line[n_along_line - 1] = field((n_along_line - 1) % nx, row);
      }
    const bool has_copy  = n_rows > 0 && end() > ny && n_along_line == nx;
    const auto first_row = fetch_rows(field, std::vector<int>(has_copy ? 1 : 0, 0));
    std::copy(first_row.rbegin(), first_row.rend(), result.rbegin());
    for_each_ghost(result, [&result](const std::size_t k, const double value) {
      result[k] = value;
    });
    return result;
  }
} // namespace strait
