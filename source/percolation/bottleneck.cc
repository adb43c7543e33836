// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/percolation/bottleneck.h>

#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
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

      Bottleneck worst{{}, std::numeric_limits<double>::infinity()};
      while (!shore.empty())
        {
          const auto [value, k] = shore.top();
          shore.pop();
          if (value < worst.value)
            worst = {lattice.point(k), value};
          if (lattice.is_outlet(k))
            return worst;
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
