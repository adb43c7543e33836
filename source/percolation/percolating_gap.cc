// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/percolating_gap.h>
#include <strait/percolation/region_clusters.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace strait
{
  namespace
  {
    /** Restore the copies at the outlet of percolating points on the seam. */
    void
    keep_seam(SlabField &kept, const SlabField &flow_gap, const FlowDirection direction)
    {
      const SlabLayout &layout = flow_gap.layout();
      const int         nx = flow_gap.grid().nx, ny = flow_gap.grid().ny;
      const auto restore = [&](const int ix, const int row, const bool neighbour_kept) {
        if (neighbour_kept && flow_gap(ix, row) > 0)
          kept(ix, row) = flow_gap(ix, row);
      };
      if (direction == FlowDirection::x)
        for (int row = 0; row < layout.n_rows(); ++row)
          restore(0, row, kept(nx - 1, row) > 0);
      else
        {
          const bool has_first = layout.n_rows() > 0 && layout.first_row() == 0;
          const auto behind =
            fetch_rows(kept, has_first ? std::vector<int>{ny - 1} : std::vector<int>{});
          for (int ix = 0; has_first && ix < nx; ++ix)
            restore(ix, 0, behind[ix] > 0);
        }
    }

    /**
     * Raise closed values such that the interpolant stays open for half a spacing
     * around every open point, however deep its neighbours are closed.
     */
    void
    limit_closed_values(SlabField &kept)
    {
      const int        nx = kept.grid().nx, n_rows = kept.layout().n_rows();
      std::vector<int> rows;
      for (int row = -1; n_rows > 0 && row <= n_rows; ++row)
        rows.push_back(kept.layout().first_row() + row);
      const std::vector<double> around = fetch_rows(kept, rows);
      for (int row = 0; row < n_rows; ++row)
        for (int ix = 0; ix < nx; ++ix)
          if (kept(ix, row) < 0)
            {
              double smallest = std::numeric_limits<double>::infinity();
              for (int b = 0; b < 3; ++b)
                for (int a = -1; a <= 1; ++a)
                  {
                    const double value =
                      around[static_cast<std::size_t>(row + b) * nx + (ix + a + nx) % nx];
                    if (value > 0)
                      smallest = std::min(smallest, value);
                  }
              kept(ix, row) = std::max(kept(ix, row), -smallest);
            }
    }
  } // namespace

  SlabField
  percolating_gap(const SlabField  &flow_gap,
                  const Clusters   &clusters,
                  const FlowDomain &domain)
  {
    if (domain.region != nullptr)
      {
        SlabField in_region = gap_around_region(flow_gap, clusters);
        limit_closed_values(in_region);
        return in_region;
      }
    SlabField kept(flow_gap.layout_pointer());
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        const NodeState state = clusters.states[k];
        if (state == NodeState::percolating || state == NodeState::closed)
          kept[k] = flow_gap[k];
      }
    keep_seam(kept, flow_gap, domain.direction);
    limit_closed_values(kept);
    return kept;
  }
} // namespace strait
