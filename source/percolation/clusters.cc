// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace strait
{
  namespace
  {
    /** Find the first number of the set that @p k is in (union–find): each number leads
     *  to an earlier one of its set. The chain from @p k is shortened on the way. */
    std::int64_t
    root_of(std::vector<std::int64_t> &parent, std::int64_t k)
    {
      while (parent[k] != k)
        k = parent[k] = parent[parent[k]];
      return k;
    }

    void
    join(std::vector<std::int64_t> &parent, const std::int64_t a, const std::int64_t b)
    {
      const std::int64_t root_a = root_of(parent, a), root_b = root_of(parent, b);
      parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
    }

    /** The sets of joined open points that this rank knows, in the form of root_of(). */
    std::vector<std::int64_t>
    join_points(const FlowLattice &gap)
    {
      std::vector<std::int64_t> parent(gap.size());
      std::iota(parent.begin(), parent.end(), 0);
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (gap[k] > 0)
          gap.for_each_step(k, 2, [&](const FlowLattice::Step &step) {
            // A copy of the seam is joined to the point before it, not to other copies.
            if (gap[step.point] > 0 && !gap.is_copy(step.from))
              join(parent, k, step.point);
          });
      return parent;
    }

    /** The clusters of open lattice points over all ranks. */
    struct LatticeClusters
    {
      /** Find the clusters of @p gap. Collective. */
      explicit LatticeClusters(const FlowLattice &gap);

      /** The number of the cluster of point @p k, the same on all ranks; 0 if it is
       *  closed. */
      std::int64_t
      operator[](const std::size_t k) const
      {
        return cluster_of_part[part_of_point[k]];
      }

      // `part_of_point`: the part of its cluster that this rank knows; 0 if the point
      // is closed. `cluster_of_part`: the first part of the same cluster on any rank.
      std::vector<std::int64_t> part_of_point, cluster_of_part;
    };

    LatticeClusters::LatticeClusters(const FlowLattice &gap)
      : part_of_point(join_points(gap))
    {
      const MPI_Comm comm = gap.communicator;
      std::int64_t   next = rank_in(comm) + 1;
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (!(gap[k] > 0))
          part_of_point[k] = 0;
        else if (part_of_point[k] != static_cast<std::int64_t>(k))
          part_of_point[k] = part_of_point[part_of_point[k]];
        else
          {
            part_of_point[k] = next;
            next += n_ranks_in(comm);
          }
      // Pairs of parts on different ranks that have a point in common.
      std::vector<std::array<std::int64_t, 2>> same;
      const auto link = [&](const std::size_t k, const std::int64_t theirs) {
        if (gap[k] > 0 &&
            (same.empty() || same.back() != std::array{part_of_point[k], theirs}))
          same.push_back({part_of_point[k], theirs});
      };
      gap.for_each_ghost(part_of_point, link);
      const auto                windows = part_of_point.begin() + gap.levels.n_on_grid;
      std::vector<std::int64_t> in_windows;
      if (rank_in(comm) == 0)
        in_windows.assign(windows, part_of_point.end());
      in_windows = gather_all(comm, in_windows);
      for (std::size_t i = 0; i < in_windows.size(); ++i)
        link(gap.levels.n_on_grid + i, in_windows[i]);

      cluster_of_part.resize(
        static_cast<std::size_t>(maximum(comm, static_cast<double>(next))));
      std::iota(cluster_of_part.begin(), cluster_of_part.end(), 0);
      for (const auto [a, b] : gather_all(comm, same))
        join(cluster_of_part, a, b);
      for (std::int64_t &cluster : cluster_of_part)
        cluster = cluster_of_part[cluster];
    }

    /** The number of points of each cluster at inlet or outlet. Collective. */
    std::vector<double>
    n_points_at(const OutlineKind      kind,
                const FlowLattice     &gap,
                const LatticeClusters &clusters)
    {
      std::vector<double> n(clusters.cluster_of_part.size());
      for (const std::size_t k : gap.points_at(kind))
        n[clusters[k]] += 1.;
      sum_in_place(gap.communicator, n);
      return n;
    }

    /** The state of each cluster. Collective. */
    std::vector<NodeState>
    states_of(const LatticeClusters &clusters, const FlowLattice &gap)
    {
      const std::vector<double> at_inlet = n_points_at(OutlineKind::inlet, gap, clusters);
      const std::vector<double> at_outlet =
        n_points_at(OutlineKind::outlet, gap, clusters);
      std::vector<NodeState> states(at_inlet.size());
      for (std::size_t c = 1; c < states.size(); ++c)
        states[c] = at_inlet[c] > 0 && at_outlet[c] > 0 ? NodeState::percolating
                    : at_inlet[c] > 0                   ? NodeState::inlet_side
                    : at_outlet[c] > 0                  ? NodeState::outlet_side
                                                        : NodeState::trapped;
      return states;
    }

    /** The smallest global number of each cluster's points. Collective. */
    std::vector<std::size_t>
    first_points(const LatticeClusters &clusters, const FlowLattice &gap)
    {
      std::vector<std::size_t> mine(clusters.cluster_of_part.size(), FlowLattice::none);
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (gap.is_own(k))
          mine[clusters[k]] = std::min(mine[clusters[k]], gap.global_number(k));
      std::vector<std::size_t> result = mine;
      const auto               all    = gather_all(gap.communicator, mine);
      for (std::size_t i = 0; i < all.size(); ++i)
        result[i % mine.size()] = std::min(result[i % mine.size()], all[i]);
      return result;
    }

    /** The states at the points of a region; of copies across the seam, that which comes
     *  last in NodeState and thus carries most. Collective. */
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
    const FlowLattice            lattice(open_gap, domain);
    const LatticeClusters        numbers(lattice);
    const std::vector<NodeState> states = states_of(numbers, lattice);
    const auto state_at = [&](const std::size_t k) { return states[numbers[k]]; };
    Clusters   clusters;
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
    std::vector<std::size_t> first; // point of each cluster
    if (tells_trapped)
      first = first_points(numbers, lattice);
    clusters.states.reserve(open_gap.size());
    const SlabLayout &layout = open_gap.layout();
    layout.for_each_point([&](GridPoint point) {
      if (point.window >= 0) // outermost points take the cluster of the next one inside
        {
          const ZoomWindow &window = layout.windows()[point.window];
          point.ix                 = std::clamp(point.ix, 1, window.n_columns() - 2);
          point.iy                 = std::clamp(point.iy, 1, window.n_rows() - 2);
        }
      const std::size_t k = lattice.number_at(point); // on the seam: at the inlet
      // An outermost point of a window may be closed where the next one inside is open.
      const bool is_open = open_gap[clusters.states.size()] > 0;
      clusters.states.push_back(is_open ? state_at(k) : NodeState::closed);
      if (tells_trapped)
        clusters.trapped.push_back(clusters.states.back() == NodeState::trapped
                                     ? static_cast<std::int64_t>(first[numbers[k]])
                                     : -1);
    });
    return clusters;
  }
} // namespace strait
