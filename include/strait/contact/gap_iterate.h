// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_iterate_h
#define strait_contact_gap_iterate_h

#include <strait/contact/gap_optimisation.h>

#include <vector>

namespace strait
{
  /**
   * A gap g >= 0 on its way down in energy, and what follows from it: the elastic
   * traction Kw and the derivative r of the energy by g. What all optimisers of the
   * gap share.
   */
  class GapIterate
  {
  public:
    /** Holds two fields. */
    GapIterate(GapProblem &problem, const GapConstraint &constraint);

    /** Start at @p gap, which is made admissible, and whose array is from now on
     *  worked on. One application of K; collective. */
    void start(double *gap);

    /** K w of the gap as it is, after it was changed by others. Likewise. */
    void refresh();

    /**
     * g += length·d, where the response is K d and <d, Kd> is @p work; negative
     * values that rounding leaves become 0. Collective.
     */
    void
    move(const double *direction, const double *response, double work, double length);

    /** The values that an admissible gap may not have become the nearest ones, at
     *  the prescribed mean. Collective. */
    void make_admissible(double *gap) const;

    /** Values 0 off the free points, and at fixed mean gap of the mean 0 on them.
     *  Collective. */
    void project(double *values) const;

    /** Open, or in contact but pulled away: free to move. */
    bool
    is_free(const std::size_t i) const
    {
      return gap[i] > 0 || derivative[i] < 0;
    }

    /** γ'' at a point. */
    double
    curvature(const std::size_t i) const
    {
      return law.curvature(derivative[i] - elastic[i] - pressure);
    }

    double
    energy() const
    {
      return elastic_energy + adhesive_energy;
    }

    /** Largest violation of the conditions of a minimum [pressure]. */
    double
    violation() const
    {
      return largest_violation;
    }

    /** No contact, and the load pulls at least twice as strongly as any point. */
    bool is_detached() const;

    /** Copy energies, load, gap and residual to @p solution. */
    void describe(GapSolution &solution) const;

    GapProblem         &problem;
    const GapConstraint constraint;
    double             *gap = nullptr;
    std::vector<double> elastic;    // K w
    std::vector<double> derivative; // r = K w + γ'(g) + p0

  private:
    void evaluate();

    const AdhesionLaw law;
    double            pressure        = 0; // p0, at fixed mean gap so that ⟨r⟩ = 0
    double            elastic_energy  = 0; // ½⟨w, Kw⟩, and p0 ⟨g⟩ at fixed load
    double            adhesive_energy = 0;
    double            largest_violation = 0;
    double            smallest_gap      = 0;
  };
} // namespace strait

#endif
