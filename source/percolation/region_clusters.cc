// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
    /** The open points that are joined to the open ones among @p sources. */
    std::vector<bool>
    flood(const FlowLattice &gap, std::vector<std::size_t> sources)
    {
      std::vector<bool> reached(gap.size(), false);
      const auto        visit = [&](const std::size_t k) {
        if (!(gap[k] > 0) || reached[k])
          return false;
        return static_cast<bool>(reached[k] = true);
      };
      sources.erase(std::remove_if(sources.begin(),
                                   sources.end(),
                                   [&](const std::size_t k) { return !visit(k); }),
                    sources.end());
      while (!sources.empty())
        {
          const std::size_t k = sources.back();
          sources.pop_back();
          gap.for_each_step(k, 4, [&](const FlowLattice::Step &step) {
            if (visit(step.point))
              sources.push_back(step.point);
          });
        }
      return reached;
    }

    /** States at the grid points as numbers; of copies the one that carries more. */
    std::vector<double>
    label(const FlowLattice &gap, const FlowRegion &region, const PeriodicGrid &grid)
    {
      std::vector<std::size_t> outlet_points;
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (gap.is_outlet(k))
          outlet_points.push_back(k);
      const std::vector<bool> from_inlet  = flood(gap, gap.inlet_points());
      const std::vector<bool> from_outlet = flood(gap, std::move(outlet_points));
      std::vector<double>     states(grid.n_points(),
                                 static_cast<double>(NodeState::outside));
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (region.is_inside(k))
          {
            const NodeState state = !(gap[k] > 0) ? NodeState::closed
                                    : from_inlet[k] && from_outlet[k]
                                      ? NodeState::percolating
                                    : from_inlet[k]  ? NodeState::inlet_side
                                    : from_outlet[k] ? NodeState::outlet_side
                                                     : NodeState::trapped;
            const GridPoint point = gap.point(k);
            double &here = states[static_cast<std::size_t>(point.iy % grid.ny) * grid.nx +
                                  point.ix % grid.nx];
            const auto value = static_cast<double>(state);
            here             = here == static_cast<double>(NodeState::outside)
                                 ? value
                                 : std::max(here, value);
          }
      return states;
    }
  } // namespace

  Clusters
  find_clusters_in_region(const SlabField &open_gap, const FlowDomain &domain)
  {
    MPI_Comm            comm = open_gap.layout().communicator();
    const FlowLattice   lattice(open_gap, domain);
    std::vector<double> states;
    run_on_root(comm,
                [&]() { states = label(lattice, *domain.region, open_gap.grid()); });
    Clusters clusters;
    for (const double value : scatter_from_root(open_gap.layout_pointer(), states))
      clusters.states.push_back(static_cast<NodeState>(static_cast<int>(value)));
    const long long n_percolating =
      std::count(clusters.states.begin(), clusters.states.end(), NodeState::percolating);
    clusters.percolates = sum(comm, n_percolating) > 0;
    return clusters;
  }
} // namespace strait
