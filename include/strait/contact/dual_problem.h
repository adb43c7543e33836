// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_dual_problem_h
#define strait_contact_dual_problem_h

#include <cstddef>
#include <functional>
#include <vector>

namespace strait
{
  /**
   * A contact problem as an optimiser sees it: minimise ½<p, Gp> − <p, h> over
   * pressures p >= 0. Knows neither elasticity nor how the points lie.
   *
   * Fields are arrays of size() values of this rank. <a, b> is the mean of a·b
   * over the nominal area. All member functions that say so are collective.
   */
  class DualProblem
  {
  public:
    virtual ~DualProblem() = default;

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
    using Pass     = std::function<void(const Block &range)>;
    using WorkPass = std::function<void(const Block &range, double work)>;

    virtual std::size_t size() const = 0;

    /** Disjoint blocks that cover all points of this rank. */
    virtual const std::vector<Block> &blocks() const = 0;

    /** The heights h [length]. */
    virtual const double *heights() const = 0;

    /**
     * u = G p. Returns the work <p, Gp>. Collective.
     * before() is called for ranges that cover all points before p is read there,
     * and may write p; the scratch() values of its range are as they were.
     * after() gets the work and is called when u is complete on its range.
     */
    virtual double apply(const double   *pressure,
                         double         *displacement,
                         const Pass     &before,
                         const WorkPass &after) = 0;

    /**
     * Replace @p values by M values, where M is a cheap symmetric positive
     * approximation of the inverse of G, up to a factor. Collective.
     * before() is called for ranges that cover all points before the values are
     * read there, and may write them; after() when the result is complete on its
     * range.
     */
    virtual void precondition(double *values, const Pass &before, const Pass &after) = 0;

    /** Room for size() values that lasts until the next apply(). */
    virtual double *scratch() = 0;

    /** Collective: sums over the ranks, all in one message. */
    virtual void sum_over_ranks(double *values, int count) const = 0;

    /** Collective: the largest over the ranks. */
    virtual double largest_over_ranks(double value) const = 0;

    /** How often apply() was called (FFT pairs on a plain grid). */
    virtual long n_applications() const = 0;
  };
} // namespace strait

#endif
