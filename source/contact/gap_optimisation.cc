// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_conjugate_gradients.h>
#include <strait/contact/gap_dynamics.h>
#include <strait/contact/gap_newton.h>
#include <strait/contact/gap_optimisation.h>

#include <utility>

namespace strait
{
  std::unique_ptr<GapOptimiser>
  make_gap_optimiser(const AdhesionMethod method,
                     GapProblem          &problem,
                     const GapConstraint &constraint,
                     const GapTolerance  &tolerance,
                     RelaxationObserver   o)
  {
    if (method == AdhesionMethod::newton_cg)
      return std::make_unique<GapNewton>(problem, constraint, tolerance, std::move(o));
    if (method == AdhesionMethod::gfmd)
      return std::make_unique<GapDynamics>(problem, constraint, tolerance, std::move(o));
    return std::make_unique<GapConjugateGradients>(problem,
                                                   constraint,
                                                   tolerance,
                                                   std::move(o));
  }
} // namespace strait
