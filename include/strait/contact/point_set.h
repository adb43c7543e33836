// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_point_set_h
#define strait_contact_point_set_h

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace strait
{
  /**
   * The points of a contact problem as an optimiser sees them: how many this rank
   * has, what area each stands for, and how to sum over all of them. Fields are
   * arrays of size() values of this rank.
   */
  class PointSet
  {
  public:
    virtual ~PointSet() = default;

    /** Points begin <= i < end of this rank that stand for the same area. */
    struct Block
    {
      std::size_t begin;
      std::size_t end;
      double      weight; // area of one point over the nominal area
    };

    /**
     * What an optimiser does with a range of points just before or after the
     * problem does, while they are in the cache. Passes may not communicate.
     */
    using Pass = std::function<void(const Block &range)>;

    virtual std::size_t size() const = 0;

    /** Disjoint blocks that cover all points of this rank. */
    virtual const std::vector<Block> &blocks() const = 0;

    /** Collective: sums over the ranks, all in one message. */
    virtual void sum_over_ranks(double *values, int count) const = 0;

    /** Collective: the largest over the ranks. */
    virtual double largest_over_ranks(double value) const = 0;
  };

  /** N sums over points, weighted by area. */
  template <std::size_t N>
  class WeightedSums
  {
  public:
    /** add(i, sums) adds the values of point i of @p range to the N sums. */
    template <class Add>
    void
    run_over(const PointSet::Block &range, const Add &add)
    {
      std::array<double, N> sums{};
      for (std::size_t i = range.begin; i < range.end; ++i)
        add(i, sums);
      for (std::size_t k = 0; k < N; ++k)
        local[k] += range.weight * sums[k];
    }

    /** Collective: the sums over all ranks. */
    std::array<double, N>
    over_ranks(const PointSet &points) const
    {
      std::array<double, N> total = local;
      points.sum_over_ranks(total.data(), static_cast<int>(N));
      return total;
    }

  private:
    std::array<double, N> local{};
  };

  /** The same over all points at once. Collective. */
  template <std::size_t N, class Add>
  std::array<double, N>
  weighted_sums(const PointSet &points, const Add &add)
  {
    WeightedSums<N> sums;
    for (const PointSet::Block &block : points.blocks())
      sums.run_over(block, add);
    return sums.over_ranks(points);
  }

  /** Nothing to do before or after. */
  inline void
  no_pass(const PointSet::Block &)
  {
  }
} // namespace strait

#endif
