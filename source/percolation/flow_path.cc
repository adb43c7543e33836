// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/flow_path.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    constexpr std::uint8_t start_of_path = 255;

    /** Searches for paths on the gap, and bars the way to later ones. */
    class PathSearch
    {
    public:
      explicit PathSearch(const FlowLattice &lattice)
        : gap(lattice)
        , blocked(lattice.size(), false)
      {
      }

      /** The least-resistance path that avoids blocked points; empty if there is none of
       *  less than @p most. */
      FlowPath run(double most);

      /** Bar the throats of @p path to later searches. */
      void block_throats(const FlowPath &path);

    private:
      bool
      is_open(const std::size_t k) const
      {
        return gap[k] > 0 && !blocked[k];
      }

      static double
      resistivity(const double g)
      {
        return g > 0 ? 1. / (g * g * g) : infinity;
      }

      double step_resistance(const FlowLattice::Step &step) const;

      /** From point @p k of the grid to the nearest closed one, in spacings. */
      int reach_of(std::size_t k) const;

      FlowPath trace_back(std::size_t                      end,
                          const std::vector<std::uint8_t> &came_by) const;

      const FlowLattice  &gap;
      std::vector<bool>   blocked;
      std::vector<double> resistance;
    };

    double
    PathSearch::step_resistance(const FlowLattice::Step &step) const
    {
      if (!is_open(step.point))
        return infinity;
      const double here = gap[step.from], there = gap[step.to];
      const double mean_ends = .5 * (resistivity(here) + resistivity(there));
      if (step.d_along == 0 || step.d_across == 0)
        return mean_ends * step.length;
      // Two corners that merely touch are no channel.
      const double side_1 =
        gap.can_go_around(step, true) ? gap[step.from + step.d_along] : 0.;
      const double side_2 =
        gap.can_go_around(step, false) ? gap[step.to - step.d_along] : 0.;
      if (!(side_1 > 0) && !(side_2 > 0))
        return infinity;
      const double middle =
        .25 * (here + there + std::max(side_1, 0.) + std::max(side_2, 0.));
      return std::max(mean_ends, resistivity(middle)) * step.length;
    }

    FlowPath
    PathSearch::run(const double most)
    {
      using Entry = std::pair<double, std::size_t>;
      resistance.assign(gap.size(), infinity);
      std::vector<std::uint8_t> came_by(gap.size(), start_of_path);
      std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
      for (const std::size_t k : gap.inlet_points())
        if (is_open(k))
          {
            resistance[k] = 0;
            queue.emplace(0., k);
          }
      while (!queue.empty())
        {
          const auto [so_far, k] = queue.top();
          queue.pop();
          if (so_far > resistance[k])
            continue;
          if (gap.is_outlet(k))
            return trace_back(k, came_by);
          const double here = so_far;
          gap.for_each_step(k, 8, [&](const FlowLattice::Step &step) {
            const double total = here + step_resistance(step);
            if (total < resistance[step.point] && total <= most)
              {
                resistance[step.point] = total;
                came_by[step.point]    = step.number;
                queue.emplace(total, step.point);
              }
          });
        }
      return {};
    }

    FlowPath
    PathSearch::trace_back(std::size_t                      end,
                           const std::vector<std::uint8_t> &came_by) const
    {
      FlowPath path;
      path.bottleneck_gap = infinity;
      for (std::size_t k = end;;)
        {
          path.points.push_back(gap.point(k));
          path.gaps.push_back(gap[k]);
          path.resistances.push_back(resistance[k]);
          if (gap[k] < path.bottleneck_gap)
            {
              path.bottleneck_gap = gap[k];
              path.bottleneck     = path.points.back();
            }
          if (came_by[k] == start_of_path)
            break;
          k = gap.start_of(k, came_by[k]);
        }
      std::reverse(path.points.begin(), path.points.end());
      std::reverse(path.gaps.begin(), path.gaps.end());
      std::reverse(path.resistances.begin(), path.resistances.end());
      return path;
    }

    int
    PathSearch::reach_of(const std::size_t k) const
    {
      // The shortest bars a way through a gap between two points, and one around a
      // corner. A throat of more than twice the longest is no throat.
      constexpr int shortest = 2, longest = 32;
      int           reach   = shortest;
      const auto    is_open = [this](const std::size_t near) { return gap[near] > 0; };
      for (; reach < longest; ++reach)
        {
          const std::vector<std::size_t> near = gap.points_around(k, reach);
          if (!std::all_of(near.begin(), near.end(), is_open))
            break;
        }
      return reach;
    }

    void
    PathSearch::block_throats(const FlowPath &path)
    {
      // A throat is where the resistivity is a twentieth of the bottleneck's or more.
      // Half of that bars wider places, which other paths may share; double of it lets
      // the next path run beside this one.
      const double threshold = .05 * resistivity(path.bottleneck_gap);
      // Many points in a window share one of the grid.
      std::size_t last = gap.size();
      for (const GridPoint &point : path.points)
        {
          const std::size_t k = gap.index_of(point), on_grid = gap.on_grid(k);
          if (resistivity(gap[k]) <= threshold || on_grid == last)
            continue;
          last = on_grid;
          for (const std::size_t near : gap.points_around(on_grid, reach_of(on_grid)))
            blocked[near] = true;
        }
    }

    void
    broadcast_path(FlowPath &path, MPI_Comm comm)
    {
      auto n_points = static_cast<int>(path.points.size());
      MPI_Bcast(&n_points, 1, MPI_INT, 0, comm);
      path.points.resize(n_points);
      for (std::vector<double> *values : {&path.gaps, &path.resistances})
        {
          values->resize(n_points);
          MPI_Bcast(values->data(), n_points, MPI_DOUBLE, 0, comm);
        }
      static_assert(sizeof(GridPoint) == 3 * sizeof(int));
      MPI_Bcast(path.points.data(), 3 * n_points, MPI_INT, 0, comm);
      MPI_Bcast(&path.bottleneck, 3, MPI_INT, 0, comm);
      MPI_Bcast(&path.bottleneck_gap, 1, MPI_DOUBLE, 0, comm);
    }
  } // namespace

  std::vector<FlowPath>
  find_flow_paths(const SlabField   &gap,
                  const FlowDomain  &domain,
                  const unsigned int n_paths)
  {
    // Paths of more resistance than that, over the first one's, carry no flow that
    // counts, and a search that ends there is short. Half of it misses channels of half a
    // percent of the flow, double of it searches for what no accuracy asks for.
    constexpr double          largest_ratio = 500.;
    MPI_Comm                  comm          = gap.layout().communicator();
    const std::vector<double> whole         = gather_on_root(gap);
    std::vector<FlowPath>     paths;
    run_on_root(comm, [&]() {
      const FlowLattice lattice(whole, gap, domain);
      PathSearch        search(lattice);
      while (paths.size() < n_paths)
        {
          double most = infinity;
          if (!paths.empty())
            {
              most = largest_ratio * paths.front().resistance();
              search.block_throats(paths.back());
            }
          FlowPath path = search.run(most);
          if (path.points.empty())
            break;
          paths.push_back(std::move(path));
        }
    });
    auto n_found = static_cast<int>(paths.size());
    MPI_Bcast(&n_found, 1, MPI_INT, 0, comm);
    paths.resize(n_found);
    for (FlowPath &path : paths)
      broadcast_path(path, comm);
    return paths;
  }
} // namespace strait
