// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_stability_h
#define strait_contact_gap_stability_h

#include <strait/contact/gap_optimisation.h>

#include <vector>

namespace strait
{
  /**
   * Whether a stationary gap is a minimum of the energy.
   *
   * Points in contact are held by the wall. On the others the smallest eigenvalue μ of
   * (K + γ'') v = μ (K + mean_stiffness() M) v, M the mean, is sought by a descent of the
   * Rayleigh quotient in the space of v, its preconditioned gradient and the last change
   * of v (LOBPCG for one vector, Knyazev 2001). It is at most 1; a minimum has μ > 0. The
   * quotient bounds μ from above, so a negative one is proof that the gap is no minimum.
   */
  class GapStability
  {
  public:
    /** Of @p problem, which must outlive this object. Keeps one field; needs six. */
    GapStability(GapProblem &problem, GapConstraint::Kind kind);

    /**
     * The smallest quotient found for @p gap, where γ'' is @p curvature; with an early
     * stop once it is negative. Starts from direction(), from noise if that is empty.
     * Collective.
     */
    double smallest_curvature(const double *gap, const double *curvature);

    /** The direction v in which the quotient is smallest; 0 in contact. */
    const std::vector<double> &
    direction() const
    {
      return vectors[0];
    }
    std::vector<double> &
    direction()
    {
      return vectors[0];
    }

    std::size_t memory_consumption() const;

  private:
    void   find_lowest();
    void   prepare(std::vector<double> &v, std::vector<double> &stiffness);
    void   mask(std::vector<double> &v) const;
    void   descend(int n_vectors);
    double uniform_part(const std::vector<double> &v) const;

    GapProblem               &problem;
    const GapConstraint::Kind kind;
    const double             *gap       = nullptr;
    const double             *curvature = nullptr; // γ''

    // v, its gradient, its last change; K of each.
    std::vector<double> vectors[3];
    std::vector<double> responses[3];
    double              quotient = 0;
  };
} // namespace strait

#endif
