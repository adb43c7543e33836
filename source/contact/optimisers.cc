// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

namespace strait
{
  ContactSolution
  find_pressure(const ContactMethod      method,
                DualProblem             &problem,
                const ContactConstraint &constraint,
                const ContactTolerance  &tolerance,
                double                  *pressure,
                double                  *gap)
  {
    if (method == ContactMethod::polonsky_keer)
      return PolonskyKeer(problem, constraint, tolerance, pressure, gap).solve();
    return DualConjugateGradients(problem, constraint, tolerance, pressure, gap).solve();
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
