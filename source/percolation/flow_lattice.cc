// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_lattice.h>

namespace strait
{
  FlowLattice::FlowLattice(const std::vector<double> &whole,
                           const PeriodicGrid        &grid,
                           const FlowDomain          &domain)
    : region(domain.region)
    , along_x(region != nullptr || domain.direction == FlowDirection::x)
    , n_along((along_x ? grid.nx : grid.ny) + 1)
    , across((along_x ? grid.ny : grid.nx) + (region != nullptr ? 1 : 0))
    , step_along(along_x ? grid.dx() : grid.dy())
    , step_across(along_x ? grid.dy() : grid.dx())
    , values(static_cast<std::size_t>(n_along) * across)
  {
    const int period = along_x ? grid.ny : grid.nx;
    for (int b = 0; b < across; ++b)
      for (int a = 0; a < n_along; ++a)
        {
          const int         a0 = a % (n_along - 1), b0 = b % period;
          const std::size_t k = index(a, b);
          if (is_point(k))
            values[k] = along_x ? whole[static_cast<std::size_t>(b0) * grid.nx + a0]
                                : whole[static_cast<std::size_t>(a0) * grid.nx + b0];
        }
  }

  std::vector<std::size_t>
  FlowLattice::inlet_points() const
  {
    std::vector<std::size_t> points;
    if (region == nullptr)
      for (int b = 0; b < across; ++b)
        points.push_back(index(0, b));
    else
      for (std::size_t k = 0; k < size(); ++k)
        if (region->is_inlet(k))
          points.push_back(k);
    return points;
  }

  bool
  FlowLattice::can_step_in_region(const std::size_t k,
                                  const int         d_along,
                                  const int         d_across) const
  {
    if (d_along == 0 || d_across == 0)
      return region->is_joined(k, d_along, d_across);
    return can_go_around(k, d_along, d_across, true) ||
           can_go_around(k, d_along, d_across, false);
  }
} // namespace strait
