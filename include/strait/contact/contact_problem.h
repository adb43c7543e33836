// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_problem_h
#define strait_contact_contact_problem_h

#include <strait/base/collective.h>
#include <strait/contact/adhesion_law.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * A contact problem as an optimiser sees it: the points that this rank has, what area
   * and height each has, how to sum over all of them, and a preconditioner. Knows neither
   * elasticity nor how the points lie. Fields are arrays of size() values of this rank;
   * <a, b> is the mean of a·b over the nominal area, <a> that of a.
   */
  class ContactProblem
  {
  public:
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

    /** What there is on this rank: disjoint blocks that cover all points, and the heights
     *  h [length], which must outlive the problem. */
    struct Points
    {
      MPI_Comm           communicator;
      std::size_t        size;
      const double      *heights;
      std::vector<Block> blocks;
    };

    explicit ContactProblem(Points points_)
      : points(std::move(points_))
    {
    }

    virtual ~ContactProblem() = default;

    std::size_t
    size() const
    {
      return points.size;
    }

    const std::vector<Block> &
    blocks() const
    {
      return points.blocks;
    }

    const double *
    heights() const
    {
      return points.heights;
    }

    /** How often the operator was applied (FFT pairs on a plain grid). */
    virtual long n_applications() const = 0;

    /** Collective: sums over the ranks, all in one message. */
    void
    sum_over_ranks(double *values, const int count) const
    {
      sum_in_place(points.communicator, values, count);
    }

    /** Collective: the largest over the ranks. */
    double
    largest_over_ranks(const double value) const
    {
      return maximum(points.communicator, value);
    }

  private:
    const Points points;
  };

  /**
   * Without adhesion: minimise ½<p, Gp> − <p, h> over pressures p >= 0. A step on the way
   * and what it makes of the gap need no more than seven digits, for the gap is found
   * anew from the pressure in the end.
   */
  class DualProblem : public ContactProblem
  {
  public:
    using ContactProblem::ContactProblem;

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
     * Replace @p values by M values, where M is symmetric and positive and resembles the
     * inverse of G up to a factor. Collective.
     */
    virtual void precondition(float *values, const Pass &before, const Pass &after) = 0;

    /** Room for size() values that lasts until the next respond(). */
    virtual float *scratch() = 0;
  };

  /**
   * With adhesion: minimise ½⟨w, Kw⟩ + ⟨γ(g)⟩ + p0 ⟨g⟩ over gaps g >= 0, where w = g + h
   * and K vanishes on constants. M is the inverse of K + mean_stiffness() ⟨·⟩.
   */
  class GapProblem : public ContactProblem
  {
  public:
    GapProblem(Points points_, const AdhesionLaw &adhesion_)
      : ContactProblem(std::move(points_))
      , adhesion(adhesion_)
    {
    }

    const AdhesionLaw adhesion;

    /** traction = K w. Returns <w, Kw>. Collective. */
    virtual double
    apply(const double *displacement, double *traction, const Pass &before) = 0;

    /** Replace @p values by M values. Collective. */
    virtual void precondition(double *values, const Pass &before) = 0;

    /** What stands in M for the stiffness of a uniform gap [pressure/length]. */
    virtual double mean_stiffness() const = 0;

    /** Rough values of the order one, the same however the points are dealt out. */
    virtual void fill_with_noise(double *values) const = 0;
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
      problem.sum_over_ranks(total.data(), static_cast<int>(N));
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
    for (const ContactProblem::Block &block : problem.blocks())
      sums.run_over(block, add);
    return sums.over_ranks(problem);
  }
} // namespace strait

#endif
