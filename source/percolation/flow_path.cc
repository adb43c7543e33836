// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_path.h>
#include <strait/percolation/lattice_search.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr double infinity = LatticeSearch::infinity;

    double
    resistivity(const double g)
    {
      return g > 0 ? 1. / (g * g * g) : infinity;
    }

    /** Searches for paths on the gap, and bars the way to later ones. All collective. */
    class PathSearch
    {
    public:
      explicit PathSearch(const FlowLattice &lattice)
        : gap(lattice)
        , search(lattice, 8)
        , blocked(lattice.size(), false)
      {
      }

      /** The least-resistance path that avoids blocked points; empty if there is none of
       *  no more than @p most. */
      FlowPath
      run(const double most)
      {
        const LatticeSearch::End end = search.run(
          gap.points_at(OutlineKind::inlet),
          [this](const std::size_t k) { return is_open(k) ? 0. : infinity; },
          [this](const double here, const FlowLattice::Step &step) {
            return here + step_resistance(step);
          },
          [this](const std::size_t k) { return gap.is_outlet(k); },
          most);
        return end.cost < infinity ? trace_back(end.point) : FlowPath();
      }

      /** Bar the throats of @p path to later searches. */
      void
      block_throats(const FlowPath &path)
      {
        // A throat is where the resistivity is a twentieth of the bottleneck's or more.
        // Half of that bars wider places, which other paths may share; double of it lets
        // the next path run beside this one.
        const double           threshold = .05 * resistivity(path.bottleneck_gap);
        std::vector<GridPoint> throats;
        for (std::size_t i = 0; i < path.points.size(); ++i)
          if (resistivity(path.gaps[i]) > threshold)
            {
              // Many points in a window share one of the grid.
              const GridPoint point = gap.levels.on_grid(path.points[i]);
              if (throats.empty() || !(throats.back() == point))
                throats.push_back(point);
            }
        const std::vector<int> reaches = reaches_of(throats);
        for (std::size_t i = 0; i < throats.size(); ++i)
          for (int distance = 0; distance <= reaches[i]; ++distance)
            for (const std::size_t k : gap.points_at_distance(throats[i], distance))
              blocked[k] = true;
      }

    private:
      bool
      is_open(const std::size_t k) const
      {
        return gap[k] > 0 && !blocked[k];
      }

      double
      step_resistance(const FlowLattice::Step &step) const
      {
        if (!is_open(step.point))
          return infinity;
        const double here = gap[step.from], there = gap[step.to];
        const double mean_ends = .5 * (resistivity(here) + resistivity(there));
        if (step.corner == FlowLattice::none && step.corner_2 == FlowLattice::none)
          return mean_ends * step.length;
        // Two corners that merely touch are no channel.
        const auto at = [this](const std::size_t corner) {
          return corner == FlowLattice::none ? 0. : gap[corner];
        };
        const double side_1 = at(step.corner), side_2 = at(step.corner_2);
        if (!(side_1 > 0) && !(side_2 > 0))
          return infinity;
        const double middle =
          .25 * (here + there + std::max(side_1, 0.) + std::max(side_2, 0.));
        return std::max(mean_ends, resistivity(middle)) * step.length;
      }

      /** From points of the grid to the nearest closed ones, in spacings. */
      std::vector<int>
      reaches_of(const std::vector<GridPoint> &points) const
      {
        // The shortest bars a way through a gap between two points, and one around a
        // corner. A throat of more than twice the longest is no throat.
        constexpr int    shortest = 2, longest = 32;
        std::vector<int> reaches;
        const auto       is_open = [this](const std::size_t k) { return gap[k] > 0; };
        for (const GridPoint &point : points)
          {
            int reach = 0;
            for (; reach < longest; ++reach)
              {
                const std::vector<std::size_t> there =
                  gap.points_at_distance(point, reach);
                if (!std::all_of(there.begin(), there.end(), is_open))
                  break;
              }
            reaches.push_back(std::max(reach, shortest));
          }
        MPI_Allreduce(MPI_IN_PLACE,
                      reaches.data(),
                      static_cast<int>(reaches.size()),
                      MPI_INT,
                      MPI_MIN,
                      gap.communicator);
        return reaches;
      }

      /** The way of the last search to the end with this global number. */
      FlowPath
      trace_back(const std::size_t end) const
      {
        struct Stop
        {
          GridPoint   point;
          double      gap, resistance;
          std::size_t before; // global number
        };
        std::vector<Stop> way; // backwards
        for (std::size_t next = end; next != FlowLattice::none; next = way.back().before)
          {
            // The owner of the next point follows the path as far as it is its own.
            std::vector<Stop> part;
            for (std::size_t k = gap.own_number(next); k != FlowLattice::none;)
              {
                const bool is_start = search.last_step(k) == LatticeSearch::start_of_way;
                next =
                  is_start ? FlowLattice::none : gap.start_of(k, search.last_step(k));
                part.push_back({gap.point(k), gap[k], search.cost(k), next});
                k = is_start ? FlowLattice::none : gap.own_number(next);
              }
            part = gather_all(gap.communicator, part);
            way.insert(way.end(), part.begin(), part.end());
          }
        FlowPath path;
        for (auto stop = way.rbegin(); stop != way.rend(); ++stop)
          {
            path.points.push_back(stop->point);
            path.gaps.push_back(stop->gap);
            path.resistances.push_back(stop->resistance);
          }
        // Of points of the same gap the last one.
        const auto narrowest =
          std::min_element(way.begin(), way.end(), [](const Stop &a, const Stop &b) {
            return a.gap < b.gap;
          });
        path.bottleneck_gap = narrowest->gap;
        path.bottleneck     = narrowest->point;
        return path;
      }

      const FlowLattice &gap;
      LatticeSearch      search;
      std::vector<bool>  blocked;
    };
  } // namespace

  std::vector<FlowPath>
  find_flow_paths(const SlabField   &gap,
                  const FlowDomain  &domain,
                  const unsigned int n_paths)
  {
    // Paths of more resistance than that, over the first one's, carry no flow that
    // counts, and a search that ends there is short. Half of it misses channels of half a
    // percent of the flow, double of it searches for what no accuracy asks for.
    constexpr double      largest_ratio = 500.;
    std::vector<FlowPath> paths;
    if (n_paths == 0)
      return paths;
    const FlowLattice lattice(gap, domain);
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
    return paths;
  }
} // namespace strait
