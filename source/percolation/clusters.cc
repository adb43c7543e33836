// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

namespace strait
{
  namespace
  {
    using Label              = std::int64_t;
    constexpr Label no_label = -1;

    void
    sort_unique(std::vector<Label> &labels)
    {
      std::sort(labels.begin(), labels.end());
      labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    }

    /** Visit the open points that a rank labels: its own of the grid and, as all ranks
     *  know them, those of the windows. */
    template <class Visit>
    void
    for_each_open_point(const FlowLattice &gap, const Visit &visit)
    {
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (gap[k] > 0 && (gap.is_own(k) || gap.in_window(k)))
          visit(k);
    }

    /** Labels of the clusters at the points of a lattice. */
    class Labels
    {
    public:
      /** Collective. */
      explicit Labels(const FlowLattice &gap_)
        : gap(gap_)
        , labels(gap.size(), no_label)
      {
        label_here();
        join_ranks();
        find_reservoirs();
      }

      /** What the first point of the cluster is called that point @p k is of; no_label if
       * it is closed. */
      Label
      operator[](const std::size_t k) const
      {
        return labels[k];
      }

      /** What point @p k is to the fluid. */
      NodeState
      state(const std::size_t k) const
      {
        const bool in  = std::binary_search(inlet.begin(), inlet.end(), labels[k]);
        const bool out = std::binary_search(outlet.begin(), outlet.end(), labels[k]);
        return !(gap[k] > 0) ? NodeState::closed
               : in && out   ? NodeState::percolating
               : in          ? NodeState::inlet_side
               : out         ? NodeState::outlet_side
                             : NodeState::trapped;
      }

    private:
      void label_here();
      void join_ranks();
      void find_reservoirs();

      const FlowLattice                &gap;
      std::vector<Label>                labels;
      std::vector<std::array<Label, 2>> touching;      // are of one cluster
      std::vector<Label>                inlet, outlet; // that touch them, sorted
    };

    /** Label by what this rank knows, grid and windows apart, so that the labels of the
     *  latter are the same on all ranks. */
    void
    Labels::label_here()
    {
      // Union–find: the smallest point of a set is its root.
      std::vector<std::size_t> parent(gap.size());
      std::iota(parent.begin(), parent.end(), std::size_t(0));
      const auto root_of = [&parent](std::size_t k) {
        while (parent[k] != k)
          k = parent[k] = parent[parent[k]];
        return k;
      };
      std::vector<std::array<std::size_t, 2>> into_windows;
      for_each_open_point(gap, [&](const std::size_t k) {
        if (gap.is_copy(k))
          return;
        gap.for_each_step(k, 4, [&](const FlowLattice::Step &step) {
          // What joins two points is seen from the first of them.
          if (step.point < k || !(gap[step.point] > 0))
            return;
          if (gap.in_window(step.point) != gap.in_window(k))
            {
              into_windows.push_back({{k, step.point}});
              return;
            }
          const auto [low, high] = std::minmax({root_of(k), root_of(step.point)});
          parent[high]           = low;
        });
      });
      for_each_open_point(gap, [&](const std::size_t k) {
        if (Label &label = labels[root_of(k)]; label == no_label)
          label = static_cast<Label>(gap.place_in_field(k));
      });
      for (std::size_t k = 0; k < labels.size(); ++k)
        labels[k] = labels[root_of(k)];
      for (const auto &[from, to] : into_windows)
        touching.push_back({{labels[from], labels[to]}});
    }

    /** Give labels that belong together, here and on other ranks, the least of their
     *  names. Collective. */
    void
    Labels::join_ranks()
    {
      gap.grid_lines().for_each_ghost(labels,
                                      [&](const std::size_t k, const Label label) {
                                        if (labels[k] != no_label)
                                          touching.push_back({{labels[k], label}});
                                      });
      touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
      const auto                       pairs = gather_all(gap.communicator(), touching);
      std::unordered_map<Label, Label> lesser; // names of the same cluster

      // Halves the way for the next one that asks.
      const auto least = [&lesser](Label name) {
        auto found = lesser.find(name);
        while (found != lesser.end())
          {
            if (const auto next = lesser.find(found->second); next != lesser.end())
              found->second = next->second;
            name  = found->second;
            found = lesser.find(name);
          }
        return name;
      };
      for (const auto &[a, b] : pairs)
        if (const auto [low, high] = std::minmax({least(a), least(b)}); low != high)
          lesser[high] = low;
      if (lesser.empty())
        return;
      for (Label &label : labels)
        label = least(label);
    }

    /** Collective. */
    void
    Labels::find_reservoirs()
    {
      const auto labels_at = [this](const std::vector<std::size_t> &points) {
        std::vector<Label> mine;
        for (const std::size_t k : points)
          if (gap[k] > 0)
            mine.push_back(labels[k]);
        sort_unique(mine);
        std::vector<Label> all = gather_all(gap.communicator(), mine);
        sort_unique(all);
        return all;
      };
      inlet  = labels_at(gap.points_at(OutlineKind::inlet));
      outlet = labels_at(gap.points_at(OutlineKind::outlet));
    }

    /** The states at the points of a region, of copies across the seam that which carries
     *  more. Collective. */
    std::vector<NodeState>
    states_in_region(const Labels        &labels,
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
            const auto state = static_cast<double>(labels.state(k));
            here             = here == outside ? state : std::max(here, state);
          }
      std::vector<NodeState> states;
      for (const double state : scatter_from_root(layout, whole))
        states.push_back(static_cast<NodeState>(static_cast<int>(state)));
      return states;
    }

    /** Call visit(k) with the point of @p lattice for each value of a field on @p layout,
     *  on the seam that at the inlet; the outermost points of a window stand for those
     *  inside of them. */
    template <class Visit>
    void
    for_each_value(const SlabLayout  &layout,
                   const FlowLattice &lattice,
                   const Visit       &visit)
    {
      for (int row = 0; row < layout.n_rows(); ++row)
        for (int ix = 0; ix < layout.grid().nx; ++ix)
          visit(lattice.number_at({ix, layout.first_row() + row}));
      for (int w = 0; w < static_cast<int>(layout.windows().size()); ++w)
        {
          const int n_columns = layout.windows()[w].n_columns();
          const int n_rows    = layout.windows()[w].n_rows();
          for (int iy = 0; iy < n_rows; ++iy)
            for (int ix = 0; ix < n_columns; ++ix)
              visit(lattice.number_at(
                {std::clamp(ix, 1, n_columns - 2), std::clamp(iy, 1, n_rows - 2), w}));
        }
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
    const FlowLattice      lattice(open_gap, domain);
    const Labels           labels(lattice);
    Clusters               clusters;
    std::vector<GridPoint> leaks;
    for (const std::size_t k : lattice.points_at(OutlineKind::outlet))
      if (labels.state(k) == NodeState::percolating)
        leaks.push_back(lattice.point(k));
    clusters.leaks      = gather_all(lattice.communicator(), leaks);
    clusters.percolates = !clusters.leaks.empty();
    if (domain.region != nullptr)
      {
        clusters.states =
          states_in_region(labels, *domain.region, open_gap.layout_pointer());
        return clusters;
      }
    for_each_value(open_gap.layout(), lattice, [&](const std::size_t k) {
      // On the outermost points of windows the gap itself may be closed.
      const bool is_open = open_gap[clusters.states.size()] > 0;
      clusters.states.push_back(is_open ? labels.state(k) : NodeState::closed);
      if (tells_trapped)
        clusters.trapped.push_back(
          clusters.states.back() == NodeState::trapped ? labels[k] : no_label);
    });
    return clusters;
  }
} // namespace strait
