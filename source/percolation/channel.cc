// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/channel.h>
#include <strait/spectral/fill_windows.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    /** The states of the points, where a point on the seam also percolates if its copy at
     *  the outlet does. */
    std::vector<NodeState>
    states_of_both_ends(const SlabLayout &layout, const Clusters &clusters)
    {
      std::vector<NodeState> states = clusters.states;
      for (const GridPoint &point : clusters.leaks)
        if (const std::size_t k = layout.index_of(point); k < states.size())
          states[k] = NodeState::percolating;
      return states;
    }

    /** Close the points outside a region that are far from all percolating ones. */
    void
    close_far_outside(SlabField &gap, const Clusters &clusters)
    {
      // How far outside the outline, in spacings, the interpolant of an open cell may
      // take values. Half of it would change the gap at the outline; double of it only
      // keeps values that nothing reads.
      constexpr int reach = 2;
      SlabField     leaks(gap.layout_pointer());
      for (std::size_t k = 0; k < leaks.size(); ++k)
        leaks[k] = clusters.states[k] == NodeState::percolating ? 1. : 0.;
      const RowsAround around(leaks, reach);
      const auto       is_near_leak = [&](const GridPoint &point) {
        for (int b = -reach; b <= reach; ++b)
          for (int a = -reach; a <= reach; ++a)
            if (around.at({point.ix + a, point.iy + b}) > 0)
              return true;
        return false;
      };
      std::size_t k = 0;
      gap.layout().for_each_point([&](const GridPoint &point) {
        if (clusters.states[k] == NodeState::outside && gap[k] > 0 &&
            !is_near_leak(point))
          gap[k] = 0.;
        ++k;
      });
    }

    /** Raise closed values to at least minus the smallest open value around them, on all
     *  levels, so that the interpolant stays open for half a spacing around every open
     *  point, however negative its neighbours are. */
    void
    limit_closed_values(SlabField &gap)
    {
      const RowsAround around(gap);
      double          *next = gap.data();
      gap.layout().for_each_point([&](const GridPoint &point) {
        double &value = *next++;
        if (!(value < 0))
          return;
        double smallest = std::numeric_limits<double>::infinity();
        for (int b = -1; b <= 1; ++b)
          for (int a = -1; a <= 1; ++a)
            if (const double neighbour =
                  around.at({point.ix + a, point.iy + b, point.window});
                neighbour > 0)
              smallest = std::min(smallest, neighbour);
        value = std::max(value, -smallest);
      });
      copy_to_covered(gap);
    }
  } // namespace

  SlabField
  percolating_gap(SlabField open_gap, const Clusters &clusters, const FlowDomain &domain)
  {
    const std::vector<NodeState> states =
      domain.region != nullptr ? clusters.states
                               : states_of_both_ends(open_gap.layout(), clusters);
    for (std::size_t k = 0; k < open_gap.size(); ++k)
      if (open_gap[k] > 0 && states[k] != NodeState::percolating &&
          states[k] != NodeState::outside)
        open_gap[k] = 0.;
    if (domain.region != nullptr)
      close_far_outside(open_gap, clusters);
    limit_closed_values(open_gap);
    return open_gap;
  }

  Channel
  make_channel(const SlabField   &gap,
               const double       slip_length,
               const FlowDomain  &domain,
               const unsigned int n_paths,
               const bool         tells_trapped)
  {
    Channel   channel;
    SlabField open   = open_gap(gap, slip_length);
    channel.clusters = find_clusters(open, domain, tells_trapped);
    if (!channel.percolates())
      return channel;
    channel.gap   = percolating_gap(std::move(open), channel.clusters, domain);
    channel.paths = find_flow_paths(channel.gap, domain, n_paths);
    if (!channel.paths.empty())
      channel.throat = measure_throat(gap, slip_length, channel.paths.front().bottleneck);
    return channel;
  }

  std::vector<Constriction>
  divide_into_constrictions(const std::vector<double> &gaps)
  {
    // Half of it, that is any widening at all, counts one throat as several; double of it
    // several as one. It matters to the report, to windows and to the marking of cells.
    constexpr double          distinct = 1.5;
    const std::size_t         end      = gaps.size() - 1;
    std::vector<Constriction> result   = {{0, end, 0}};
    std::size_t               widest   = 0; // since the narrowest point
    for (std::size_t k = 1; k < gaps.size(); ++k)
      {
        Constriction &here = result.back();
        if (gaps[k] > gaps[widest])
          widest = k;
        if (gaps[widest] > distinct * std::max(gaps[here.narrowest], gaps[k]))
          {
            here.last = widest;
            result.push_back({widest, end, k});
            widest = k;
          }
        else if (gaps[k] < gaps[here.narrowest])
          {
            here.narrowest = k;
            widest         = k;
          }
      }
    return result;
  }

  std::vector<ThroatOnPath>
  throats(const Channel &channel, const SlabField &gap, const double slip_length)
  {
    std::vector<ThroatOnPath> result;
    for (const FlowPath &path : channel.paths)
      for (const Constriction &c : divide_into_constrictions(path.gaps))
        {
          const GridPoint &point   = path.points[c.narrowest];
          const auto       is_here = [&point](const ThroatOnPath &other) {
            return other.point == point;
          };
          if (std::any_of(result.begin(), result.end(), is_here))
            continue;
          // The share of the drop along its path, scaled by the flow along the path.
          const double fraction =
            (path.resistances[c.last] - path.resistances[c.first]) / path.resistance() *
            (channel.paths.front().resistance() / path.resistance());
          // Measured in the contact's gap: a throat on the seam continues beyond it,
          // where the channel's own gap may be closed.
          result.push_back(
            {point, fraction, measure_throat(gap, slip_length, point).points});
        }
    return result;
  }
} // namespace strait
