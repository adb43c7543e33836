// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

namespace strait
{
  std::unique_ptr<DualOptimiser>
  make_dual_optimiser(const ContactMethod      method,
                      DualProblem             &problem,
                      const ContactConstraint &constraint,
                      const ContactTolerance  &tolerance)
  {
    if (method == ContactMethod::polonsky_keer)
      return std::make_unique<PolonskyKeer>(problem, constraint, tolerance);
    return std::make_unique<DualConjugateGradients>(problem, constraint, tolerance);
  }

  std::unique_ptr<GapOptimiser>
  make_gap_optimiser(const AdhesionMethod    method,
                     GapProblem             &problem,
                     const GapConstraint    &constraint,
                     const ContactTolerance &tolerance)
  {
    if (method == AdhesionMethod::newton_cg)
      return std::make_unique<GapNewton>(problem, constraint, tolerance);
    if (method == AdhesionMethod::gfmd)
      return std::make_unique<GapDynamics>(problem, constraint, tolerance);
    return std::make_unique<GapConjugateGradients>(problem, constraint, tolerance);
  }
} // namespace strait
