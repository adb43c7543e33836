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
   * The least costs of ways over a lattice, from given points to the nearest end, where
   * the cost of a way does not decrease from step to step.
   *
   * It is Dijkstra's algorithm block by block: blocks of points that fit a processor's
   * cache are searched one at a time, first the one with the least cost to begin with,
   * and what a better way reaches later is searched again. Ranks search their own points
   * at the same time, and tell each other what they found when they have no block left.
   * The costs are those of Dijkstra's algorithm, to the last digit, on any number of
   * ranks.
   */
  class LatticeSearch
  {
  public:
    /** Of ways with the first @p n_directions of a point's steps. */
    LatticeSearch(const FlowLattice &lattice, int n_directions);

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /** The least cost of a way, infinite if there is none, and the global number of the
     * end that it leads to. */
    struct End
    {
      double      cost  = infinity;
      std::size_t point = FlowLattice::none;
    };

    /**
     * Search from this rank's @p starts, where ways cost start(k), to the points where
     * is_end(k), but no ways of more than @p most; a way costs total(cost where the last
     * step begins, that step). Collective.
     */
    template <class Start, class Total, class IsEnd>
    End run(const std::vector<std::size_t> &starts,
            const Start                    &start,
            const Total                    &total,
            const IsEnd                    &is_end,
            double                          most = infinity);

    /** The least cost to point @p k, if it is less than that of the end. */
    double
    cost(const std::size_t k) const
    {
      return costs[k];
    }

    static constexpr std::uint8_t start_of_way = 255;

    /** The number of the last step of the way to this rank's point @p k. */
    std::uint8_t
    last_step(const std::size_t k) const
    {
      return last_steps[k];
    }

  private:
    using Entry = std::pair<double, std::size_t>; // cost, and point or block

    /** Whether the cost of @p a is more; which of equals is the first does not matter. */
    struct CostsMore
    {
      bool
      operator()(const Entry &a, const Entry &b) const
      {
        return a.first > b.first;
      }
    };

    /** A better way was found to point @p k, whose steps are to be searched. */
    void improve(std::size_t k, double cost, std::uint8_t step);

    /** The block that point @p k is in: a square of points, or a window. */
    std::size_t block_of(std::size_t k) const;

    /** Search what is pending in block @p b. */
    template <class Total, class IsEnd>
    void search_block(std::size_t b, const Total &total, const IsEnd &is_end);

    /** Take over what other ranks found. @return whether some rank has blocks to search
     *  then. Collective. */
    bool exchange();

    const FlowLattice        &lattice;
    int                       n_directions;
    std::vector<double>       costs;
    std::vector<std::uint8_t> last_steps;
    double                    limit = 0.; // of costs that count
    End                       best;
    std::vector<std::size_t>  found_in_windows; // since the last exchange

    // Points to be searched by block, the least cost of those of each, and the blocks
    // that have some, of which entries with other costs are outdated.
    std::vector<std::vector<Entry>>                           pending;
    std::vector<double>                                       least_pending;
    std::priority_queue<Entry, std::vector<Entry>, CostsMore> blocks;

    std::size_t        block_at_work = FlowLattice::none;
    std::vector<Entry> heap; // of its points
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
          // Ghosts are their owner's affair; windows are, but for the way into them.
          if (costs[step.point] <= here ||
              (!lattice.is_own(step.point) && !(own && lattice.in_window(step.point))))
            return;
          const double there = total(here, step);
          if (there < costs[step.point] && there <= limit)
            improve(step.point, there, step.number);
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
    // Ranks tell each other what they found whenever they have searched so many of their
    // blocks: one that waits for another to be done searches nothing meanwhile, and what
    // it does without the other's ways it does again. On two ranks 2048² points take 0.74
    // of the time that they take told at the end only; a quarter or four times as many
    // parts take 0.8.
    constexpr std::size_t parts       = 64;
    const std::size_t     most_blocks = pending.size() / parts + 1;
    costs.assign(lattice.size(), infinity);
    last_steps.assign(lattice.size(), start_of_way);
    limit = most;
    best  = {};
    for (const std::size_t k : starts)
      if (start(k) < costs[k])
        improve(k, start(k), start_of_way);
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
