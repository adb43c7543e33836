// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/flow_in_a_row.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    SlabLayoutPtr
    two_of(const SlabLayout &one)
    {
      PeriodicGrid grid = one.grid();
      grid.nx *= 2;
      grid.lx *= 2.;
      return make_layout(grid, one.communicator());
    }
  } // namespace

  FlowInARow::FlowInARow(const FluidParameters &fluid,
                         const SlabLayout      &one,
                         Log                   &log,
                         Timers                &timers)
    : layout(two_of(one))
    , flow(fluid, layout, log, timers)
  {
  }

  Leakage
  FlowInARow::solve(const SlabField &gap, const double slip_length)
  {
    // Rows are dealt out by their number alone, so that each rank has its own twice.
    SlabField two(layout);
    const int nx = gap.grid().nx;
    for (int row = 0; row < gap.layout().n_rows(); ++row)
      for (const int half : {0, 1})
        std::copy_n(&gap.data()[static_cast<std::size_t>(row) * nx],
                    nx,
                    &two(half * nx, row));
    return flow.solve(two, slip_length).leakage;
  }
} // namespace strait
