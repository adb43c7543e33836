// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/lattice_search.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    void
    sort_unique(std::vector<double> &labels)
    {
      std::sort(labels.begin(), labels.end());
      labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    }

    /** Whether none of this rank's points before @p k has a step to it. */
    bool
    may_be_first(const FlowLattice &gap, const std::size_t k)
    {
      bool result = true;
      gap.for_each_step(k, 4, [&](const FlowLattice::Step &step) {
        if (step.point < k && gap.is_own(step.point) && gap[step.point] > 0 &&
            !gap.is_copy(step.point))
          result = false;
      });
      return result;
    }

    /** Find labels of the clusters as costs of points: the least of the numbers of a
     *  cluster's points, which spreads over it from point to point; infinite at closed
     *  ones. Collective. */
    void
    find_labels(const FlowLattice &gap, LatticeSearch &search)
    {
      std::vector<std::size_t> starts;
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (gap.is_own(k) && gap[k] > 0 && may_be_first(gap, k))
          starts.push_back(k);
      search.run(
        starts,
        [&](const std::size_t k) { return static_cast<double>(gap.global_number(k)); },
        [&](const double label, const FlowLattice::Step &step) {
          // Copies of the seam are joined to the points before them, not to each other.
          const bool joins = gap[step.point] > 0 && !gap.is_copy(step.from);
          return joins ? label : LatticeSearch::infinity;
        },
        [](std::size_t) { return false; });
    }

    /** The labels of all ranks there, sorted. Collective. */
    std::vector<double>
    labels_at(const OutlineKind kind, const FlowLattice &gap, const LatticeSearch &search)
    {
      std::vector<double> mine;
      for (const std::size_t k : gap.points_at(kind))
        if (gap[k] > 0)
          mine.push_back(search.cost(k));
      sort_unique(mine);
      std::vector<double> all = gather_all(gap.communicator, mine);
      sort_unique(all);
      return all;
    }

    /** The states at the points of a region, of copies across the seam that which carries
     *  more. Collective. */
    template <class StateAt>
    std::vector<NodeState>
    states_in_region(const StateAt       &state_at,
                     const FlowRegion    &region,
                     const SlabLayoutPtr &layout)
    {
      const PeriodicGrid &grid    = layout->grid();
      const double        outside = static_cast<double>(NodeState::outside);
      std::vector<double> whole(layout->rank() == 0 ? grid.n_points() : 0, outside);
      for (std::size_t k = 0; k < region.size(); ++k)
        if (region.is_inside(k))
          {
            const std::size_t width = grid.nx + 1;
            double    &here  = whole[k / width % grid.ny * grid.nx + k % width % grid.nx];
            const auto state = static_cast<double>(state_at(k));
            here             = here == outside ? state : std::max(here, state);
          }
      std::vector<NodeState> states;
      for (const double state : scatter_from_root(layout, whole))
        states.push_back(static_cast<NodeState>(static_cast<int>(state)));
      return states;
    }
  } // namespace

  SlabField
  open_gap(SlabField gap, const double slip_length)
  {
    for (double &value : gap)
      value = open_gap(value, slip_length);
    return gap;
  }

  Clusters
  find_clusters(const SlabField  &open_gap,
                const FlowDomain &domain,
                const bool        tells_trapped)
  {
    const FlowLattice lattice(open_gap, domain);
    LatticeSearch     search(lattice, 4);
    find_labels(lattice, search);
    const auto at_inlet  = labels_at(OutlineKind::inlet, lattice, search);
    const auto at_outlet = labels_at(OutlineKind::outlet, lattice, search);
    const auto state_at  = [&](const std::size_t k) {
      const double label = search.cost(k);
      const bool   in    = std::binary_search(at_inlet.begin(), at_inlet.end(), label);
      const bool   out   = std::binary_search(at_outlet.begin(), at_outlet.end(), label);
      return !(lattice[k] > 0) ? NodeState::closed
              : in && out       ? NodeState::percolating
              : in              ? NodeState::inlet_side
              : out             ? NodeState::outlet_side
                                : NodeState::trapped;
    };
    Clusters               clusters;
    std::vector<GridPoint> leaks;
    for (const std::size_t k : lattice.points_at(OutlineKind::outlet))
      if (state_at(k) == NodeState::percolating)
        leaks.push_back(lattice.point(k));
    clusters.leaks      = gather_all(lattice.communicator, leaks);
    clusters.percolates = !clusters.leaks.empty();
    if (domain.region != nullptr)
      {
        clusters.states =
          states_in_region(state_at, *domain.region, open_gap.layout_pointer());
        return clusters;
      }
    const SlabLayout &layout = open_gap.layout();
    layout.for_each_point([&](GridPoint point) {
      if (point.window >= 0) // whose outermost points stand for those inside of them
        {
          const ZoomWindow &window = layout.windows()[point.window];
          point.ix                 = std::clamp(point.ix, 1, window.n_columns() - 2);
          point.iy                 = std::clamp(point.iy, 1, window.n_rows() - 2);
        }
      const std::size_t k = lattice.number_at(point); // on the seam that at the inlet
      // On the outermost points of windows the gap itself may be closed.
      const bool is_open = open_gap[clusters.states.size()] > 0;
      clusters.states.push_back(is_open ? state_at(k) : NodeState::closed);
      if (tells_trapped)
        clusters.trapped.push_back(clusters.states.back() == NodeState::trapped
                                     ? static_cast<std::int64_t>(search.cost(k))
                                     : -1);
    });
    return clusters;
  }
} // namespace strait
