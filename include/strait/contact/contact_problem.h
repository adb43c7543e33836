// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/spectral/slab_layout.h>

#include <array>
#include <cstdint>
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
    const MPI_Comm      communicator;
    const std::size_t   size;    // of the arrays that fields are on this rank
    const double *const heights; // h [length]; they must outlive the problem
    // Of what an array has elsewhere, at points that finer ones cover, nothing is meant.
    const std::vector<SlabLayout::Range> ranges;
    const double n_points; // the nominal area, in the unit of those of the ranges
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

    /** u = G p. Returns the work <p, Gp>. Collective. */
    virtual double apply(const double *pressure, double *displacement) = 0;

    /** The same of a step, to seven digits; the response may take its place. Collective.
     */
    virtual double respond(const float *step, float *response) = 0;

    /**
     * Replace @p values by M values at the points that @p marks are of; what stands at
     * the others before must be 0, and then means nothing. M is symmetric and positive on
     * the marked points and resembles the inverse of G there, up to a factor. Collective.
     */
    virtual void precondition(float *values, const std::uint8_t *marks) = 0;

    /** Room for `size` values that lasts until the next respond(), which may use it. */
    virtual float *scratch() = 0;

    /** How often the operator was applied (FFT pairs on a plain grid). */
    virtual long n_applications() const = 0;
  };

  /** When an optimiser stops. */
  struct ContactTolerance
  {
    double residual; // in units of `unit`
    double unit;     // of a gap or, with adhesion, of a traction: the surface's own scale
    int    max_iterations; // one for each direction that is followed
  };

  /** N sums over all points, weighted by area: add_point(i, sums) adds the values of
   *  point i to them. Collective. */
  template <std::size_t N, class Add>
  std::array<double, N>
  weighted_sums(const ContactProblem &problem, const Add &add_point)
  {
    std::array<double, N> total{};
    for (const SlabLayout::Range &range : problem.ranges)
      {
        std::array<double, N> sums{};
        for (std::size_t i = range.begin; i < range.end; ++i)
          add_point(i, sums);
        for (std::size_t k = 0; k < N; ++k)
          total[k] += range.area / problem.n_points * sums[k];
      }
    sum_in_place(problem.communicator, total);
    return total;
  }
} // namespace strait
