// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_dual_problem_h
#define strait_contact_dual_problem_h

#include <strait/contact/point_set.h>

namespace strait
{
  /**
   * A contact problem as an optimiser sees it: minimise ½<p, Gp> − <p, h> over
   * pressures p >= 0. Knows neither elasticity nor how the points lie.
   *
   * <a, b> is the mean of a·b over the nominal area. All member functions that say
   * so are collective.
   */
  class DualProblem : public PointSet
  {
  public:
    /** A pass that is told the work. */
    using WorkPass = std::function<void(const Block &range, double work)>;

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

    /** How often apply() was called (FFT pairs on a plain grid). */
    virtual long n_applications() const = 0;
  };
} // namespace strait

#endif
