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
   * The local points of a contact problem as an optimiser sees them, without elasticity
   * and positions. <a, b> is the mean of a·b over the nominal area, <a> that of a.
   */
  struct ContactProblem
  {
    const MPI_Comm      communicator;
    const std::size_t   size;    // of a field's array on this rank
    const double *const heights; // h [length]; they must outlive the problem
    // All other points are covered by finer ones; a field's values there are meaningless.
    const std::vector<SlabLayout::Range> ranges;
    const double n_points; // of the grid: the nominal area in the unit of Range::area
  };

  /**
   * Contact without adhesion: minimise ½<p, Gp> − <p, h> over pressures p >= 0. Steps and
   * their responses need no more than seven digits, because in the end the gap is
   * computed anew from the pressure.
   */
  class DualProblem : public ContactProblem
  {
  public:
    explicit DualProblem(const ContactProblem &points)
      : ContactProblem(points)
    {
    }

    virtual ~DualProblem() = default;

    /** Compute u = G p. Return the work <p, Gp>. Collective. */
    virtual double apply(const double *pressure, double *displacement) = 0;

    /** As apply(), to seven digits. Both arrays may be the same. Collective. */
    virtual double respond(const float *step, float *response) = 0;

    /**
     * Replace @p values by M @p values at the points whose @p marks are not 0. At all
     * other points they must be 0 on entry and are meaningless on return. On the marked
     * points M is symmetric, positive and, up to a factor, close to the inverse of G.
     * Collective.
     */
    virtual void precondition(float *values, const std::uint8_t *marks) = 0;

    /** Scratch memory for `size` values. The next respond() may overwrite it. */
    virtual float *scratch() = 0;

    /** How often G was applied so far (FFT pairs on the grid). */
    virtual long n_applications() const = 0;
  };

  /** When an optimiser stops. */
  struct ContactTolerance
  {
    double residual;       // in units of `unit`
    double unit;           // the surface's scale of gaps or, with adhesion, of tractions
    int    max_iterations; // each follows one direction
  };

  /** Return N sums over all points, each weighted by its share of the nominal area, so
   *  that a sum is a mean: add_point(i, sums) adds the values of point i. Collective. */
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
