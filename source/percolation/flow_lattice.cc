// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_lattice.h>

namespace strait
{
  FlowLattice::FlowLattice(const std::vector<double> &whole,
                           const PeriodicGrid        &grid,
                           const FlowDirection        direction)
    : along_x(direction == FlowDirection::x)
    , n_along((along_x ? grid.nx : grid.ny) + 1)
    , across(along_x ? grid.ny : grid.nx)
    , step_along(along_x ? grid.dx() : grid.dy())
    , step_across(along_x ? grid.dy() : grid.dx())
    , values(static_cast<std::size_t>(n_along) * across)
  {
    for (int b = 0; b < across; ++b)
      for (int a = 0; a < n_along; ++a)
        {
          const int a0        = a % (n_along - 1);
          values[index(a, b)] = along_x
                                  ? whole[static_cast<std::size_t>(b) * grid.nx + a0]
                                  : whole[static_cast<std::size_t>(a0) * grid.nx + b];
        }
  }
} // namespace strait
