// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/lattice_search.h>

#include <limits>

namespace strait
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
  }

  LatticeSearch::LatticeSearch(const FlowLattice &lattice, const int n_directions)
    : lattice(lattice)
    , n_directions(n_directions)
    , pending(lattice.n_blocks())
    , least_pending(lattice.n_blocks(), infinity)
  {
    MPI_Comm_rank(lattice.communicator(), &best.rank);
  }

  void
  LatticeSearch::reset(const double most)
  {
    costs.assign(lattice.size(), infinity);
    last_steps.assign(lattice.size(), start_of_way);
    limit = most;
    best  = {infinity, best.rank, FlowLattice::none};
  }

  void
  LatticeSearch::improve(const std::size_t k, const double cost, const std::uint8_t step)
  {
    costs[k]      = cost;
    last_steps[k] = step;
    if (lattice.in_window(k))
      found_in_windows.push_back(k);
    const std::size_t b = lattice.block_of(k);
    if (b == block_at_work)
      {
        heap.emplace_back(cost, k);
        std::push_heap(heap.begin(), heap.end(), std::greater<>());
        return;
      }
    pending[b].emplace_back(cost, k);
    if (cost < least_pending[b])
      {
        least_pending[b] = cost;
        blocks.emplace(cost, b);
      }
  }

  bool
  LatticeSearch::exchange()
  {
    const GridLines &lines = lattice.grid_lines();
    lines.for_each_ghost(costs, [this](const std::size_t k, const double cost) {
      if (cost < costs[k])
        improve(k, cost, start_of_way);
    });
    if (lattice.size() > lines.size())
      exchange_in_windows();
    limit = minimum(lattice.communicator(), limit);
    return sum(lattice.communicator(), static_cast<long long>(blocks.size())) > 0;
  }

  void
  LatticeSearch::exchange_in_windows()
  {
    struct Finding
    {
      std::size_t   point; // in the windows
      double        cost;
      std::uint64_t step;
    };
    MPI_Comm             comm = lattice.communicator();
    std::vector<Finding> mine;
    for (const std::size_t k : std::exchange(found_in_windows, {}))
      mine.push_back({k - lattice.grid_lines().size(), costs[k], last_steps[k]});
    for (const Finding &found : gather_all(comm, mine))
      if (const std::size_t k = lattice.grid_lines().size() + found.point;
          found.cost < costs[k])
        improve(k, found.cost, static_cast<std::uint8_t>(found.step));
    found_in_windows.clear();
  }

  LatticeSearch::End
  LatticeSearch::best_of_all() const
  {
    struct
    {
      double cost;
      int    rank;
    } least = {best.cost, best.rank};
    MPI_Allreduce(
      MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, lattice.communicator());
    return {least.cost, least.rank, best.point};
  }
} // namespace strait
