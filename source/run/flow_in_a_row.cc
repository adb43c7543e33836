// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/flow_in_a_row.h>

#include <algorithm>

namespace strait
{
  SlabField
  two_in_a_row(const SlabField &gap)
  {
    const int    nx   = gap.grid().nx;
    PeriodicGrid grid = gap.grid();
    grid.nx *= 2;
    grid.lx *= 2.;
    // Rows are dealt out by their number alone, so that each rank has its own twice.
    SlabField two(make_layout(grid, gap.layout().communicator()));
    for (int row = 0; row < gap.layout().n_rows(); ++row)
      for (const int half : {0, 1})
        std::copy_n(&gap.data()[static_cast<std::size_t>(row) * nx],
                    nx,
                    &two(half * nx, row));
    return two;
  }
} // namespace strait
