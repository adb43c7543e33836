// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/percolation/bottleneck.h>

#include <cmath>
#include <limits>
#include <queue>
#include <unordered_set>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    /** Steps from point @p k to the nearest one that is open if it is closed, or closed
     * if it is open; 0 if there is none. */
    int
    steps_to_other_side(const FlowLattice &lattice, const std::size_t k)
    {
      const bool                      is_open = lattice[k] > 0;
      std::vector<std::size_t>        front   = {k};
      std::unordered_set<std::size_t> seen    = {k};
      for (int steps = 1; !front.empty(); ++steps)
        {
          std::vector<std::size_t> next;
          bool                     is_found = false;
          for (const std::size_t point : front)
            lattice.for_each_step(point, 4, [&](const FlowLattice::Step &step) {
              is_found = is_found || (lattice[step.point] > 0) != is_open;
              if (seen.insert(step.point).second)
                next.push_back(step.point);
            });
          if (is_found)
            return steps;
          front = std::move(next);
        }
      return 0;
    }

    /** Flood from the inlet, always over the most open point of the shore. */
    Bottleneck
    flood(const FlowLattice &lattice)
    {
      using Entry = std::pair<double, std::size_t>;
      std::priority_queue<Entry> shore;
      std::vector<bool>          reached(lattice.size(), false);
      const auto                 reach = [&](const std::size_t k) {
        if (!reached[k])
          {
            reached[k] = true;
            shore.emplace(lattice[k], k);
          }
      };
      for (const std::size_t k : lattice.inlet_points())
        reach(k);

      double      worst    = std::numeric_limits<double>::infinity();
      std::size_t worst_at = 0;
      while (!shore.empty())
        {
          const auto [value, k] = shore.top();
          shore.pop();
          if (value < worst)
            {
              worst    = value;
              worst_at = k;
            }
          if (lattice.is_outlet(k))
            return {lattice.point(worst_at),
                    worst,
                    steps_to_other_side(lattice, worst_at)};
          lattice.for_each_step(k, 4, [&reach](const FlowLattice::Step &step) {
            reach(step.point);
          });
        }
      throw InputError(
        "The contact grid is too coarse for Fluid/Mesh: no chain of grid points leads "
        "from the inlet to the outlet; raise Contact/Grid points.");
    }
  } // namespace

  Bottleneck
  find_bottleneck(const SlabField &openness, const FlowDomain &domain)
  {
    MPI_Comm                  comm  = openness.layout().communicator();
    const std::vector<double> whole = gather_on_root(openness);
    Bottleneck                result;
    run_on_root(comm, [&]() { result = flood(FlowLattice(whole, openness, domain)); });
    MPI_Bcast(&result.point, 3, MPI_INT, 0, comm);
    MPI_Bcast(&result.value, 1, MPI_DOUBLE, 0, comm);
    MPI_Bcast(&result.reach, 1, MPI_INT, 0, comm);
    return result;
  }

  std::array<double, 2>
  position_of(const SlabLayout &layout, const GridPoint &point)
  {
    const PeriodicGrid &grid = layout.grid();
    auto [x, y]              = layout.position(point.window, point.ix, point.iy);
    if (point.window >= 0) // which may cross the seam
      {
        x -= grid.lx * std::floor(x / grid.lx);
        y -= grid.ly * std::floor(y / grid.ly);
      }
    return {{x, y}};
  }
} // namespace strait
