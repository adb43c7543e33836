// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/dual_conjugate_gradients.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/polonsky_keer.h>

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
} // namespace strait
