// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * Computes the least costs of paths on a lattice, from given points to the nearest end.
   * The cost of a path must not decrease from step to step.
   *
   * This is Dijkstra's algorithm block by block. Blocks of points that fit a processor's
   * cache are searched one at a time, that with the least pending cost first; points that
   * a cheaper path reaches later are searched again. Ranks search their own points at the
   * same time, and exchange what they found from time to time. The costs are those of
   * Dijkstra's algorithm, to the last digit, on any number of ranks.
   */
  class LatticeSearch
  {
  public:
    /** Search along the first @p n_directions steps of each point: 4 without diagonals, 8
     *  with them. @p lattice must outlive this object. */
    LatticeSearch(const FlowLattice &lattice, int n_directions);

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /** The end of the cheapest path: its cost, infinite if there is none, and its global
     *  number. */
    struct End
    {
      double      cost  = infinity;
      std::size_t point = FlowLattice::none;
    };

    /**
     * Search from this rank's @p starts, where a path costs start(k), to the points where
     * is_end(k), along paths that cost no more than @p most. A step takes a path from
     * cost c to total(c, step). @return the end, the same on all ranks. Collective.
     */
    template <class Start, class Total, class IsEnd>
    End run(const std::vector<std::size_t> &starts,
            const Start                    &start,
            const Total                    &total,
            const IsEnd                    &is_end,
            double                          most = infinity);

    /** The least cost to point @p k, if it is no more than that of the end. */
    double
    cost(const std::size_t k) const
    {
      return costs[k];
    }

    static constexpr std::uint8_t start_of_way = 255;

    /** The number of the last step to this rank's point @p k; start_of_way at a start. */
    std::uint8_t
    last_step(const std::size_t k) const
    {
      return last_steps[k];
    }

  private:
    using Entry = std::pair<double, std::size_t>; // cost, and point or block

    /** Whether @p a costs more than @p b; the order of equals does not matter. */
    struct CostsMore
    {
      bool
      operator()(const Entry &a, const Entry &b) const
      {
        return a.first > b.first;
      }
    };

    /** Note a cheaper path to point @p k, and schedule the steps from there. */
    void relax(std::size_t k, double cost, std::uint8_t step);

    /** The block of point @p k: a square of grid points, or the level of a window. */
    std::size_t block_of(std::size_t k) const;

    /** Search from the pending points of block @p b. */
    template <class Total, class IsEnd>
    void search_block(std::size_t b, const Total &total, const IsEnd &is_end);

    /** Take over what other ranks found. @return whether any rank then has blocks to
     *  search. Collective. */
    bool exchange();

    const FlowLattice        &lattice;
    int                       n_directions;
    std::vector<double>       costs;
    std::vector<std::uint8_t> last_steps;
    double                    limit = 0.; // largest cost that still counts
    End                       best;
    std::vector<std::size_t>  found_in_windows; // since the last exchange

    // By block, the points to search from and the least cost among them; and the blocks
    // that have such points, where an entry with another cost is outdated.
    std::vector<std::vector<Entry>>                           pending;
    std::vector<double>                                       least_pending;
    std::priority_queue<Entry, std::vector<Entry>, CostsMore> blocks;

    std::size_t        block_at_work = FlowLattice::none;
    std::vector<Entry> heap; // its pending points
  };

  template <class Total, class IsEnd>
  void
  LatticeSearch::search_block(const std::size_t b,
                              const Total      &total,
                              const IsEnd      &is_end)
  {
    heap.clear();
    heap.swap(pending[b]);
    least_pending[b] = infinity;
    block_at_work    = b;
    std::make_heap(heap.begin(), heap.end(), CostsMore());
    while (!heap.empty())
      {
        const double      here = heap.front().first;
        const std::size_t k    = heap.front().second;
        std::pop_heap(heap.begin(), heap.end(), CostsMore());
        heap.pop_back();
        if (here > costs[k] || here > limit)
          continue;
        const bool own = lattice.is_own(k);
        if (own && is_end(k))
          {
            if (here < best.cost)
              best = {here, lattice.global_number(k)};
            limit = std::min(limit, here);
            continue;
          }
        lattice.for_each_step(k, n_directions, [&](const FlowLattice::Step &step) {
          // Other ranks' points are left to them, except for steps into a window.
          if (costs[step.point] <= here ||
              (!lattice.is_own(step.point) && !(own && lattice.in_window(step.point))))
            return;
          const double there = total(here, step);
          if (there < costs[step.point] && there <= limit)
            relax(step.point, there, step.number);
        });
      }
    block_at_work = FlowLattice::none;
  }

  template <class Start, class Total, class IsEnd>
  LatticeSearch::End
  LatticeSearch::run(const std::vector<std::size_t> &starts,
                     const Start                    &start,
                     const Total                    &total,
                     const IsEnd                    &is_end,
                     const double                    most)
  {
    // Ranks exchange what they found each time they have searched such a part of their
    // blocks: a rank that waits for another to finish searches nothing meanwhile, and
    // must repeat what it searched without the other's paths. On two ranks, 2048² points
    // take 0.74 of the time that they take with exchanges only when no block is left; a
    // quarter or four times as many parts take 0.8.
    constexpr std::size_t parts       = 64;
    const std::size_t     most_blocks = pending.size() / parts + 1;
    costs.assign(lattice.size(), infinity);
    last_steps.assign(lattice.size(), start_of_way);
    limit = most;
    best  = {};
    for (const std::size_t k : starts)
      if (start(k) < costs[k])
        relax(k, start(k), start_of_way);
    do
      for (std::size_t n = 0; n < most_blocks && !blocks.empty();)
        {
          const auto [least, b] = blocks.top();
          blocks.pop();
          if (least != least_pending[b])
            continue;
          search_block(b, total, is_end);
          ++n;
        }
    while (exchange());
    End result;
    for (const End &end : gather_all(lattice.communicator, std::vector<End>{best}))
      if (end.cost < result.cost)
        result = end;
    return result;
  }
} // namespace strait
