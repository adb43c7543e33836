// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/lattice_search.h>

namespace strait
{
  namespace
  {
    // A block's values and what the search keeps for them fit a processor's cache. A path
    // at 4096² points takes as long with half of it, and a quarter longer with double.
    constexpr std::size_t block_size = 32; // points along both axes

    std::size_t
    blocks_along(const std::size_t n_points)
    {
      return (n_points + block_size - 1) / block_size;
    }

    std::size_t
    blocks_on_grid(const LatticeLevels &levels)
    {
      return blocks_along(levels.end - levels.first) * blocks_along(levels.length);
    }
  } // namespace

  LatticeSearch::LatticeSearch(const FlowLattice &lattice, const int n_directions)
    : lattice(lattice)
    , n_directions(n_directions)
    , pending(blocks_on_grid(lattice.levels) + lattice.levels.size() - 1)
    , least_pending(pending.size(), infinity)
  {
  }

  std::size_t
  LatticeSearch::block_of(const std::size_t k) const
  {
    const LatticeLevels &levels = lattice.levels;
    if (lattice.in_window(k))
      return blocks_on_grid(levels) + levels.level_of(k) - 1;
    const std::size_t n = levels.length, line = levels.line_of(k);
    return line / block_size * blocks_along(n) + (k - line * n) / block_size;
  }

  void
  LatticeSearch::relax(const std::size_t k, const double cost, const std::uint8_t step)
  {
    costs[k]      = cost;
    last_steps[k] = step;
    if (lattice.in_window(k))
      found_in_windows.push_back(k);
    const std::size_t b = block_of(k);
    if (b == block_at_work)
      {
        heap.emplace_back(cost, k);
        std::push_heap(heap.begin(), heap.end(), CostsMore());
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
    struct Finding
    {
      std::size_t   point; // counted from the first point of the windows
      double        cost;
      std::uint64_t step;
    };
    MPI_Comm             comm   = lattice.communicator;
    const LatticeLevels &levels = lattice.levels;
    lattice.for_each_ghost(costs, [this](const std::size_t k, const double cost) {
      if (cost < costs[k])
        relax(k, cost, start_of_way);
    });
    std::vector<Finding> mine;
    for (const std::size_t k : found_in_windows)
      mine.push_back({k - levels.n_on_grid, costs[k], last_steps[k]});
    for (const Finding &found : gather_all(comm, mine))
      if (const std::size_t k = levels.n_on_grid + found.point; found.cost < costs[k])
        relax(k, found.cost, static_cast<std::uint8_t>(found.step));
    found_in_windows.clear();
    limit = minimum(comm, limit);
    return sum(comm, static_cast<long long>(blocks.size())) > 0;
  }
} // namespace strait
