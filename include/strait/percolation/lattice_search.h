// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_lattice_search_h
#define strait_percolation_lattice_search_h

#include <strait/base/collective.h>
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * The least costs of ways over a lattice, from given points to the nearest end, where
   * the cost of a way does not decrease from step to step.
   *
   * It is Dijkstra's algorithm, in which blocks of points that fit a processor's cache
   * are searched one at a time, up to a bound on the cost that grows from band to band;
   * what a better way reaches later is searched again. Ranks search their own points at
   * the same time and tell each other what they found. The costs are those of Dijkstra's
   * algorithm, to the last digit, on any number of ranks.
   */
  class LatticeSearch
  {
  public:
    /** Of ways with the first @p n_directions of a point's steps. */
    LatticeSearch(const FlowLattice &lattice, int n_directions);

    /** The least cost of a way, infinite if there is none, and the end that it leads to
     * on the rank that knows. */
    struct End
    {
      double      cost  = std::numeric_limits<double>::infinity();
      int         rank  = 0;
      std::size_t point = FlowLattice::none;
    };

    /**
     * Search from this rank's @p starts, where ways cost start(k), to the points where
     * is_end(k), but no ways of more than @p most. A step to a point that costs less
     * than total(cost where it begins, step) makes a way; of what was not yet searched at
     * a cost of c, that up to next_bound(c) comes next. Collective.
     */
    template <class Start, class Total, class IsEnd, class NextBound>
    End run(const std::vector<std::size_t> &starts,
            const Start                    &start,
            const Total                    &total,
            const IsEnd                    &is_end,
            const NextBound                &next_bound,
            double most = std::numeric_limits<double>::infinity());

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
    using Entry = std::pair<double, std::size_t>; // cost, and point

    /** A better way was found to point @p k, whose steps are to be searched. */
    void improve(std::size_t k, double cost, std::uint8_t step);

    /** Let block @p b be searched. */
    void activate(std::size_t b);

    /** Forget earlier searches; ways cost no more than @p most. */
    void reset(double most);

    /** Search block @p b up to the bound. */
    template <class Total, class IsEnd>
    void search_block(std::size_t b, const Total &total, const IsEnd &is_end);

    /** The least cost at which steps are to be searched, of all ranks. */
    double least_pending();

    /** Take over what other ranks found. @return whether some rank has blocks to search
     *  now. Collective. */
    bool exchange();

    /** The same for points of windows. */
    void exchange_in_windows();

    /** The best end of all ranks. Collective. */
    End best_of_all() const;

    const FlowLattice              &lattice;
    int                             n_directions;
    std::vector<double>             costs;
    std::vector<std::uint8_t>       last_steps;
    std::vector<std::vector<Entry>> pending; // by block
    std::vector<char>               is_active;
    std::vector<std::size_t>        active; // blocks with something to be searched
    std::vector<std::size_t>        found_in_windows;
    std::vector<Entry>              heap;
    std::size_t                     block_at_work = FlowLattice::none;
    double                          bound = 0., limit = 0.;
    End                             best;
  };

  template <class Total, class IsEnd>
  void
  LatticeSearch::search_block(const std::size_t b,
                              const Total      &total,
                              const IsEnd      &is_end)
  {
    std::vector<Entry> &entries = pending[b];
    const auto          now     = std::partition(entries.begin(),
                                    entries.end(),
                                    [this](const Entry &e) { return e.first > bound; });
    heap.assign(now, entries.end());
    entries.erase(now, entries.end());
    std::make_heap(heap.begin(), heap.end(), std::greater<>());
    block_at_work = b;
    while (!heap.empty())
      {
        const auto [here, k] = heap.front();
        std::pop_heap(heap.begin(), heap.end(), std::greater<>());
        heap.pop_back();
        if (here > costs[k])
          continue;
        const bool own = lattice.is_own(k);
        if (own && is_end(k))
          {
            if (here < best.cost)
              best = {here, best.rank, k};
            limit = std::min(limit, here);
            continue;
          }
        lattice.for_each_step(k, n_directions, [&](const FlowLattice::Step &step) {
          // Ghosts are their owner's affair; windows are, but for the way into them.
          if (!lattice.is_own(step.point) && !(own && lattice.in_window(step.point)))
            return;
          const double there = total(here, step);
          if (there < costs[step.point] && there <= limit)
            improve(step.point, there, step.number);
        });
      }
    block_at_work = FlowLattice::none;
  }

  template <class Start, class Total, class IsEnd, class NextBound>
  LatticeSearch::End
  LatticeSearch::run(const std::vector<std::size_t> &starts,
                     const Start                    &start,
                     const Total                    &total,
                     const IsEnd                    &is_end,
                     const NextBound                &next_bound,
                     const double                    most)
  {
    reset(most);
    for (const std::size_t k : starts)
      if (start(k) < costs[k])
        improve(k, start(k), start_of_way);
    for (double least = least_pending(); least < limit; least = least_pending())
      {
        bound = next_bound(least);
        for (std::size_t b = 0; b < pending.size(); ++b)
          if (!pending[b].empty())
            activate(b);
        do
          while (!active.empty())
            {
              const std::vector<std::size_t> blocks = std::exchange(active, {});
              for (const std::size_t b : blocks)
                {
                  is_active[b] = 0;
                  search_block(b, total, is_end);
                }
            }
        while (exchange());
        limit = minimum(lattice.communicator(), limit);
      }
    return best_of_all();
  }
} // namespace strait

#endif
