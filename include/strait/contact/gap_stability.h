// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_stability_h
#define strait_contact_gap_stability_h

#include <strait/contact/contact_problem.h>

#include <vector>

namespace strait
{
  /**
   * Whether a stationary gap is a minimum of the energy: the smallest eigenvalue μ that
   * was found of (K + γ'') v = μ (K + mean_stiffness() M) v, M the mean, on the points
   * where
   * @p gap is positive, for the others are held by the wall. γ'' is @p curvature; all v
   * have the mean 0 if @p fixes_mean_gap.
   *
   * It is sought by a descent of the Rayleigh quotient in the space of v, its
   * preconditioned gradient and the last change of v (LOBPCG for one vector, Knyazev
   * 2001). It is at most 1; a minimum has μ > 0. The quotient bounds μ from above, so a
   * negative one is proof that the gap is no minimum.
   *
   * @p direction is a start for v, noise if it is empty on all ranks, and v on return.
   * Needs six fields with it. Collective.
   */
  double smallest_curvature(GapProblem          &problem,
                            bool                 fixes_mean_gap,
                            const double        *gap,
                            const double        *curvature,
                            std::vector<double> &direction);
} // namespace strait

#endif
