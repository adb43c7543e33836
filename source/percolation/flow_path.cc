// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_path.h>
#include <strait/percolation/lattice_search.h>

#include <algorithm>
#include <optional>
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

    /** Finds paths through the gap; blocks their throats to later ones. Collective. */
    class PathSearch
    {
    public:
      explicit PathSearch(const FlowLattice &lattice)
        : gap(lattice)
        , search(lattice, 8)
        , blocked(lattice.size(), false)
        , spacing(std::max(lattice.layout->grid().dx(), lattice.layout->grid().dy()))
      {
      }

      /** The path of least resistance that avoids blocked points; empty if there is none
       *  with a resistance of @p most or less. */
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

      /** Block the throats of @p path to later searches. */
      void
      block_throats(const FlowPath &path)
      {
        // A throat is where the resistivity is more than a twentieth of the bottleneck's.
        // Half of that blocks wider places, which other paths may share; double of it
        // lets the next path run beside this one.
        const double             threshold = .05 * resistivity(path.bottleneck_gap);
        std::vector<std::size_t> throats;
        for (std::size_t i = 0; i < path.points.size(); ++i)
          if (const std::size_t k = gap.number_at(path.points[i]);
              resistivity(path.gaps[i]) > threshold && k != FlowLattice::none &&
              gap.is_own(k))
            throats.push_back(k);
        if (!to_contact)
          find_contact();
        const auto reach = [this](const std::size_t k) {
          return std::clamp(to_contact->cost(k), shortest * spacing, longest * spacing);
        };
        LatticeSearch around(gap, 8);
        measure(
          around, throats, [&](const std::size_t k) { return -reach(k); }, 0.);
        for (std::size_t k = 0; k < gap.size(); ++k)
          blocked[k] = blocked[k] || around.cost(k) <= 0.;
      }

    private:
      // A throat is blocked around its points as far as the contact, within these limits
      // in spacings. The shortest also blocks a path that slips between two points or
      // around a corner. A throat wider than twice the longest is no throat.
      static constexpr double shortest = 3., longest = 32.;

      /** Measure how long paths from @p starts are, which begin with the length start(k);
       *  those longer than @p most are left out. */
      template <class Start>
      static void
      measure(LatticeSearch                  &ways,
              const std::vector<std::size_t> &starts,
              const Start                    &start,
              const double                    most)
      {
        ways.run(
          starts,
          start,
          [](const double here, const FlowLattice::Step &step) {
            return here + step.length;
          },
          [](const std::size_t) { return false; },
          most);
      }

      /** Measure the distance to the nearest closed point, up to `longest` spacings. */
      void
      find_contact()
      {
        std::vector<std::size_t> closed;
        for (std::size_t k = 0; k < gap.size(); ++k)
          if (!(gap[k] > 0) && gap.is_own(k))
            closed.push_back(k);
        to_contact.emplace(gap, 8);
        measure(
          *to_contact, closed, [](const std::size_t) { return 0.; }, longest * spacing);
      }

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
        // Two open points that merely touch at their corners are no channel.
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

      /** The path of the last search to the point with the global number @p end. */
      FlowPath
      trace_back(const std::size_t end) const
      {
        struct Stop
        {
          GridPoint   point;
          double      gap, resistance;
          std::size_t before; // global number
        };
        std::vector<Stop> way; // from outlet to inlet
        for (std::size_t next = end; next != FlowLattice::none; next = way.back().before)
          {
            // The owner of the next point follows the path as far as it owns its points.
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
        // The last one of points with the same gap.
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
      const double       spacing; // of the grid

      std::optional<LatticeSearch> to_contact; // set once there are throats to block
    };
  } // namespace

  std::vector<FlowPath>
  find_flow_paths(const SlabField   &gap,
                  const FlowDomain  &domain,
                  const unsigned int n_paths)
  {
    // Resistance over that of the first path. Paths beyond it carry no flow that matters,
    // and a search that ends there is short. Half of it misses channels with half a
    // percent of the flow; double of it searches for more than any accuracy asks for.
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
