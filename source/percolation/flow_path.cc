// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/flow_path.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    struct Step
    {
      int along;
      int across;
    };

    constexpr std::array<Step, 8> steps = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
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

      /** The least-resistance path that avoids blocked points; may be empty. */
      FlowPath run();

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

      double step_resistance(int a, int b, const Step &step) const;

      FlowPath trace_back(std::size_t                      end,
                          const std::vector<std::uint8_t> &came_by) const;

      const FlowLattice  &gap;
      std::vector<bool>   blocked;
      std::vector<double> resistance;
    };

    double
    PathSearch::step_resistance(const int a, const int b, const Step &step) const
    {
      const std::size_t here  = gap.index(a, b);
      const std::size_t there = gap.index(a + step.along, b + step.across);
      if (!is_open(there))
        return infinity;
      const double mean_ends = .5 * (resistivity(gap[here]) + resistivity(gap[there]));
      if (step.along == 0)
        return mean_ends * gap.spacing_across();
      if (step.across == 0)
        return mean_ends * gap.spacing_along();
      // Two corners that merely touch are no channel.
      const auto side = [&](const int da, const int db) {
        return gap.can_go_around(here, step.along, step.across, da != 0)
                 ? gap[gap.index(a + da, b + db)]
                 : 0.;
      };
      const double side_1 = side(step.along, 0), side_2 = side(0, step.across);
      if (!(side_1 > 0) && !(side_2 > 0))
        return infinity;
      const double middle =
        .25 * (gap[here] + gap[there] + std::max(side_1, 0.) + std::max(side_2, 0.));
      return std::max(mean_ends, resistivity(middle)) *
             std::hypot(gap.spacing_along(), gap.spacing_across());
    }

    FlowPath
    PathSearch::run()
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
          const int a = gap.along(k), b = gap.across_of(k);
          if (gap.is_outlet(k))
            return trace_back(k, came_by);
          for (std::size_t s = 0; s < steps.size(); ++s)
            {
              if (!gap.can_step(k, steps[s].along, steps[s].across))
                continue;
              const double total = so_far + step_resistance(a, b, steps[s]);
              const auto   to    = gap.index(a + steps[s].along, b + steps[s].across);
              if (total < resistance[to])
                {
                  resistance[to] = total;
                  came_by[to]    = static_cast<std::uint8_t>(s);
                  queue.emplace(total, to);
                }
            }
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
          const Step &step = steps[came_by[k]];
          k = gap.index(gap.along(k) - step.along, gap.across_of(k) - step.across);
        }
      std::reverse(path.points.begin(), path.points.end());
      std::reverse(path.gaps.begin(), path.gaps.end());
      std::reverse(path.resistances.begin(), path.resistances.end());
      return path;
    }

    void
    PathSearch::block_throats(const FlowPath &path)
    {
      // A throat is where the resistivity is a twentieth of the bottleneck's or more.
      // Half of that bars wider places, which other paths may share; double of it lets
      // the next path run beside this one.
      const double threshold = .05 * resistivity(path.bottleneck_gap);
      const int    reach     = std::min(2, gap.n_across());
      for (const GridPoint &point : path.points)
        {
          const std::size_t k = gap.index_of(point);
          if (resistivity(gap[k]) <= threshold)
            continue;
          const int a = gap.along(k), b = gap.across_of(k);
          for (int i = std::max(a - 2, 0); i <= std::min(a + 2, gap.width() - 1); ++i)
            for (int j = b - reach; j <= b + reach; ++j)
              if (gap.is_periodic() || (j >= 0 && j < gap.n_across()))
                blocked[gap.index(i, j)] = true;
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

    /** Logarithm of a gap, 50 steps to the octave, counted such that the largest gap
     *  is at the last place. Half as many places no longer tell gaps apart that are 20
     *  octaves below the largest, twice as many tell more apart than there ever are. */
    class GapScale
    {
    public:
      static constexpr int n_places = 2048;

      explicit GapScale(const FlowLattice &gap)
      {
        for (std::size_t k = 0; k < gap.size(); ++k)
          largest = std::max(largest, gap[k]);
      }

      int
      place(const double g) const
      {
        return std::max(n_places - 1 + static_cast<int>(50. * std::log2(g / largest)), 0);
      }

    private:
      double largest = 0.;
    };
  } // namespace

  std::vector<FlowPath>
  find_flow_paths(const SlabField   &gap,
                  const FlowDomain  &domain,
                  const unsigned int n_paths)
  {
    // Paths of more resistance than that, over the first one's, carry no flow that
    // counts; each of them costs a search. Half and double of it change only where the
    // mesh starts.
    constexpr double          largest_ratio = 2e4;
    MPI_Comm                  comm          = gap.layout().communicator();
    const std::vector<double> whole         = gather_on_root(gap);
    std::vector<FlowPath>     paths;
    run_on_root(comm, [&]() {
      const FlowLattice lattice(whole, gap.grid(), domain);
      PathSearch        search(lattice);
      while (paths.size() < n_paths)
        {
          FlowPath path = search.run();
          if (path.points.empty() ||
              (!paths.empty() &&
               path.resistance() > largest_ratio * paths.front().resistance()))
            break;
          search.block_throats(path);
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

  std::vector<float>
  estimate_pressure(const FlowLattice &gap, const FlowPath &path)
  {
    constexpr float                       unknown = -1.F;
    const GapScale                        scale(gap);
    std::vector<float>                    pressure(gap.size(), unknown);
    std::vector<std::vector<std::size_t>> waiting(GapScale::n_places);
    for (std::size_t p = 0; p < path.points.size(); ++p)
      {
        const std::size_t k = gap.index_of(path.points[p]);
        pressure[k] = static_cast<float>(1. - path.resistances[p] / path.resistance());
        waiting.back().push_back(k);
      }
    for (int place = GapScale::n_places - 1; place >= 0; --place)
      while (!waiting[place].empty())
        {
          const std::size_t k = waiting[place].back();
          waiting[place].pop_back();
          const int a = gap.along(k), b = gap.across_of(k);
          for (const auto &[da, db] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            {
              if (!gap.can_step(k, da, db))
                continue;
              const std::size_t to = gap.index(a + da, b + db);
              if (!(gap[to] > 0) || pressure[to] != unknown)
                continue;
              pressure[to] = pressure[k];
              waiting[std::min(place, scale.place(gap[to]))].push_back(to);
            }
        }
    return pressure;
  }
} // namespace strait
