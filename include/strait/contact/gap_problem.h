// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_problem_h
#define strait_contact_gap_problem_h

#include <strait/contact/adhesion_law.h>
#include <strait/contact/point_set.h>

namespace strait
{
  /**
   * A contact problem with adhesion as an optimiser sees it: minimise
   * ½⟨w, Kw⟩ + ⟨γ(g)⟩ + p0 ⟨g⟩ over gaps g >= 0, where w = g + h. Knows neither
   * elasticity nor how the points lie.
   *
   * <a, b> is the mean of a·b over the nominal area, <a> that of a. K vanishes on
   * constants.
   */
  class GapProblem : public PointSet
  {
  public:
    /** The heights h [length]. */
    virtual const double *heights() const = 0;

    virtual const AdhesionLaw &adhesion() const = 0;

    /**
     * traction = K w. Returns ⟨w, Kw⟩. Collective.
     * before() is called for ranges that cover all points before w is read there, and
     * may write w; after() when the traction is complete on its range.
     */
    virtual double apply(const double *displacement,
                         double       *traction,
                         const Pass   &before,
                         const Pass   &after) = 0;

    /**
     * Replace @p values by M values, where M is a symmetric positive approximation
     * of the inverse of K + mean_stiffness() ⟨·⟩. Collective; passes as in apply().
     */
    virtual void precondition(double *values, const Pass &before, const Pass &after) = 0;

    /** What stands in M for the stiffness of a uniform gap [pressure/length]. */
    virtual double mean_stiffness() const = 0;

    /** Rough values of the order one, the same however the points are dealt out. */
    virtual void fill_with_noise(double *values) const = 0;

    /** FFT pairs on the whole grid so far. */
    virtual long n_applications() const = 0;
  };
} // namespace strait

#endif
