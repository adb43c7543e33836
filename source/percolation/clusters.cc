// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/local_clusters.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace strait
{
  namespace
  {
    using Label              = std::int64_t;
    constexpr Label no_label = -1;

    /** Labels that are right within each slab, and among the windows: the number of the
     *  root, where the windows' points follow those of the whole grid. */
    std::vector<Label>
    label_slab(const SlabField &gap, const FlowDirection direction)
    {
      const SlabLayout &layout = gap.layout();
      DisjointSets      sets   = join_open_points(gap, direction);
      const Label first_label  = static_cast<Label>(layout.first_row()) * gap.grid().nx;
      const Label of_windows =
        static_cast<Label>(gap.grid().n_points() - layout.n_local_points());
      std::vector<Label> labels(gap.size(), no_label);
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (gap[k] > 0)
          labels[k] = static_cast<Label>(sets.find(k)) +
                      (k < layout.n_local_points() ? first_label : of_windows);
      return labels;
    }

    /** The row of labels that follows this rank's last one. Collective. */
    std::vector<double>
    fetch_next_row(const SlabField &gap, const std::vector<Label> &labels)
    {
      // Labels are below 2^53, so that doubles carry them exactly.
      const int           nx     = gap.grid().nx;
      const SlabLayout   &layout = gap.layout();
      std::vector<double> first_row(labels.begin(),
                                    labels.begin() + (layout.n_rows() > 0 ? nx : 0));
      std::vector<int>    wanted;
      if (layout.n_rows() > 0)
        wanted.push_back(layout.first_row() + layout.n_rows());
      return fetch_rows(layout, first_row.data(), nx, wanted);
    }

    /** Pairs of labels that meet at the end of this slab, or at points of the grid that
     *  a window covers. Collective. */
    std::vector<Label>
    touching_labels(const SlabField          &gap,
                    const std::vector<Label> &labels,
                    const FlowDirection       direction)
    {
      const std::vector<double> next   = fetch_next_row(gap, labels);
      const SlabLayout         &layout = gap.layout();
      const int                 nx = gap.grid().nx, ny = gap.grid().ny;
      const int                 n_rows = layout.n_rows();
      std::vector<Label>        pairs;
      std::pair<Label, Label>   last(no_label, no_label);
      const auto                add = [&](const Label a, const Label b) {
        if (a == no_label || b == no_label || last == std::make_pair(a, b))
          return;
        last = {a, b};
        pairs.push_back(a);
        pairs.push_back(b);
      };
      const int  end     = layout.first_row() + n_rows;
      const bool at_seam = end == ny;
      if (n_rows > 0 && !(at_seam && direction == FlowDirection::y))
        {
          const std::vector<int> here  = covering_windows(layout, -1, end - 1),
                                 there = covering_windows(layout, -1, end % ny);
          for (int ix = 0; ix < nx; ++ix)
            if (!is_refined(here[ix], there[ix]))
              add(labels[static_cast<std::size_t>(n_rows - 1) * nx + ix],
                  static_cast<Label>(next[ix]));
        }
      for (std::size_t w = 0; w < layout.windows().size(); ++w)
        if (layout.windows()[w].parent < 0)
          layout.for_each_covered(static_cast<int>(w),
                                  [&](const std::size_t k, const std::size_t in_window) {
                                    add(labels[k], labels[in_window]);
                                  });
      return pairs;
    }

    /** Rename labels that belong together across slabs. Collective. */
    void
    merge_slabs(const SlabField    &gap,
                std::vector<Label> &labels,
                const FlowDirection direction)
    {
      const std::vector<Label> pairs =
        gather_all(gap.layout().communicator(), touching_labels(gap, labels, direction));

      std::vector<Label> names(pairs);
      std::sort(names.begin(), names.end());
      names.erase(std::unique(names.begin(), names.end()), names.end());
      const auto number_of = [&names](const Label label) {
        return static_cast<std::size_t>(
          std::lower_bound(names.begin(), names.end(), label) - names.begin());
      };
      DisjointSets sets(names.size());
      for (std::size_t k = 0; k < pairs.size(); k += 2)
        sets.join(number_of(pairs[k]), number_of(pairs[k + 1]));
      std::unordered_map<Label, Label> new_name;
      for (std::size_t k = 0; k < names.size(); ++k)
        if (sets.find(k) != k)
          new_name[names[k]] = names[sets.find(k)];
      if (new_name.empty())
        return;
      for (Label &label : labels)
        if (const auto found = new_name.find(label); found != new_name.end())
          label = found->second;
    }

    struct ReservoirLabels
    {
      std::vector<Label> inlet, outlet; // sorted
    };

    std::vector<Label>
    sorted_union(std::vector<Label> mine, MPI_Comm comm)
    {
      const auto sort_unique = [](std::vector<Label> &v) {
        std::sort(v.begin(), v.end());
        v.erase(std::unique(v.begin(), v.end()), v.end());
      };
      sort_unique(mine);
      std::vector<Label> all = gather_all(comm, mine);
      sort_unique(all);
      return all;
    }

    /** Labels that touch each reservoir. Collective. */
    ReservoirLabels
    find_reservoir_labels(const SlabField          &gap,
                          const std::vector<Label> &labels,
                          const FlowDirection       direction)
    {
      const SlabLayout  &layout = gap.layout();
      const int          nx = gap.grid().nx, ny = gap.grid().ny, n_rows = layout.n_rows();
      std::vector<Label> inlet, outlet;
      const auto visit = [&](const int ix, const int row, std::vector<Label> &set) {
        const Label label = labels[static_cast<std::size_t>(row) * nx + ix];
        if (label != no_label)
          set.push_back(label);
      };
      for (const SeamPoint &seam : seam_points(layout, direction))
        if (gap[seam.point] > 0)
          {
            inlet.push_back(labels[seam.point]);
            if (seam.behind && gap[*seam.behind] > 0)
              outlet.push_back(labels[*seam.behind]);
          }
      // Where a window lies across the seam its own points tell.
      const auto is_plain =
        [&](const int ix_last, const int iy_last, const int ix, const int iy) {
          return !is_refined(layout.covered_by(-1, ix_last, iy_last),
                             layout.covered_by(-1, ix, iy));
        };
      if (direction == FlowDirection::x)
        for (int row = 0; row < n_rows; ++row)
          {
            const int iy = layout.first_row() + row;
            visit(0, row, inlet);
            if (gap(0, row) > 0 && is_plain(nx - 1, iy, 0, iy))
              visit(nx - 1, row, outlet);
          }
      else
        {
          const bool has_first = n_rows > 0 && layout.first_row() == 0;
          const bool has_last  = n_rows > 0 && layout.first_row() + n_rows == ny;
          const auto seam =
            fetch_rows(gap, has_last ? std::vector<int>{0} : std::vector<int>{});
          for (int ix = 0; ix < nx; ++ix)
            {
              if (has_first)
                visit(ix, 0, inlet);
              if (has_last && seam[ix] > 0 && is_plain(ix, ny - 1, ix, 0))
                visit(ix, n_rows - 1, outlet);
            }
        }
      return {sorted_union(inlet, layout.communicator()),
              sorted_union(outlet, layout.communicator())};
    }

    bool
    contains(const std::vector<Label> &sorted, const Label label)
    {
      return std::binary_search(sorted.begin(), sorted.end(), label);
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
  find_clusters(const SlabField &open_gap, const FlowDomain &domain)
  {
    if (domain.region != nullptr)
      return find_clusters_in_region(open_gap, domain);
    const FlowDirection direction = domain.direction;
    std::vector<Label>  labels    = label_slab(open_gap, direction);
    merge_slabs(open_gap, labels, direction);
    const ReservoirLabels reservoirs = find_reservoir_labels(open_gap, labels, direction);

    Clusters clusters;
    clusters.states.assign(labels.size(), NodeState::closed);
    for (std::size_t k = 0; k < labels.size(); ++k)
      if (labels[k] != no_label)
        {
          const bool in      = contains(reservoirs.inlet, labels[k]);
          const bool out     = contains(reservoirs.outlet, labels[k]);
          clusters.states[k] = in && out ? NodeState::percolating
                               : in      ? NodeState::inlet_side
                               : out     ? NodeState::outlet_side
                                         : NodeState::trapped;
        }
    clusters.percolates =
      std::any_of(reservoirs.inlet.begin(),
                  reservoirs.inlet.end(),
                  [&](const Label label) { return contains(reservoirs.outlet, label); });
    return clusters;
  }

  std::vector<std::int64_t>
  trapped_labels(const SlabField    &open_gap,
                 const Clusters     &clusters,
                 const FlowDirection direction)
  {
    std::vector<Label> labels = label_slab(open_gap, direction);
    merge_slabs(open_gap, labels, direction);
    for (std::size_t k = 0; k < labels.size(); ++k)
      if (clusters.states[k] != NodeState::trapped)
        labels[k] = no_label;
    return labels;
  }
} // namespace strait
