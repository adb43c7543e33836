// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_problem_h
#define strait_contact_contact_problem_h

#include <strait/base/collective.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace strait
{
  /**
   * The points of a contact problem that this rank has, as an optimiser sees them. Knows
   * neither elasticity nor how they lie. <a, b> is the mean of a·b over the nominal area,
   * <a> that of a.
   */
  struct ContactProblem
  {
    /** Points begin <= i < end of this rank that stand for the same area. */
    struct Block
    {
      std::size_t begin;
      std::size_t end;
      double      weight; // area of one point over the nominal area
    };

    /**
     * What an optimiser does with a range of points while it is in the cache: before()
     * just before the problem reads an argument there, which it may write; after() when
     * the result is complete there. They are called for ranges that cover all points, and
     * may not communicate.
     */
    using Pass = std::function<void(const Block &range)>;

    const MPI_Comm      communicator;
    const std::size_t   size;    // of the arrays that fields are on this rank
    const double *const heights; // h [length]; they must outlive the problem
    // Disjoint. They cover all points but those that finer ones cover, where what an
    // array has means nothing.
    const std::vector<Block> blocks;
  };

  /**
   * Without adhesion: minimise ½<p, Gp> − <p, h> over pressures p >= 0. A step on the way
   * and what it makes of the gap need no more than seven digits, for the gap is found
   * anew from the pressure in the end.
   */
  class DualProblem : public ContactProblem
  {
  public:
    explicit DualProblem(const ContactProblem &points)
      : ContactProblem(points)
    {
    }

    virtual ~DualProblem() = default;

    /** A pass that is told the work. */
    using WorkPass = std::function<void(const Block &range, double work)>;

    /** u = G p. Returns the work <p, Gp>, which after() is told. Collective. */
    virtual double
    apply(const double *pressure, double *displacement, const WorkPass &after) = 0;

    /** The same of a step, to seven digits. In before() the scratch() values of its range
     *  are as they were. Collective. */
    virtual double respond(const float    *step,
                           float          *response,
                           const Pass     &before,
                           const WorkPass &after) = 0;

    /**
     * Replace @p values by M values at the points that @p marks are of; what stands at
     * the others before must be 0, and then means nothing. M is symmetric and positive on
     * the marked points and resembles the inverse of G there, up to a factor. before()
     * may still write the marks of its range. Collective.
     */
    virtual void precondition(float              *values,
                              const std::uint8_t *marks,
                              const Pass         &before,
                              const Pass         &after) = 0;

    /** Room for `size` values that lasts until the next respond(). */
    virtual float *scratch() = 0;

    /** How often the operator was applied (FFT pairs on a plain grid). */
    virtual long n_applications() const = 0;
  };

  /** Nothing to do before or after, also where the work is told. */
  inline constexpr auto no_pass = [](const ContactProblem::Block &, auto...) {};

  /** When an optimiser stops. */
  struct ContactTolerance
  {
    double residual; // in units of `unit`
    double unit;     // of a gap or, with adhesion, of a traction: the surface's own scale
    int    max_iterations; // one for each direction that is followed
  };

  /** N sums over points, weighted by area. */
  template <std::size_t N>
  class WeightedSums
  {
  public:
    /** add_point(i, sums) adds the values of point i of @p range to the N sums. */
    template <class Add>
    void
    run_over(const ContactProblem::Block &range, const Add &add_point)
    {
      std::array<double, N> sums{};
      for (std::size_t i = range.begin; i < range.end; ++i)
        add_point(i, sums);
      add(range, sums);
    }

    /** The same of sums over points of @p range that are known. */
    void
    add(const ContactProblem::Block &range, const std::array<double, N> &sums)
    {
      for (std::size_t k = 0; k < N; ++k)
        local[k] += range.weight * sums[k];
    }

    /** Collective: the sums over all ranks. */
    std::array<double, N>
    over_ranks(const ContactProblem &problem) const
    {
      std::array<double, N> total = local;
      sum_in_place(problem.communicator, total);
      return total;
    }

  private:
    std::array<double, N> local{};
  };

  /** The same over all points at once. Collective. */
  template <std::size_t N, class Add>
  std::array<double, N>
  weighted_sums(const ContactProblem &problem, const Add &add)
  {
    WeightedSums<N> sums;
    for (const ContactProblem::Block &block : problem.blocks)
      sums.run_over(block, add);
    return sums.over_ranks(problem);
  }
} // namespace strait

#endif
