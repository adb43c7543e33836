// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_make_optimiser_h
#define strait_contact_make_optimiser_h

#include <strait/base/contact_parameters.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/gap_optimisation.h>

#include <memory>

namespace strait
{
  /** The method of this name. @p problem must outlive it. */
  std::unique_ptr<DualOptimiser> make_dual_optimiser(ContactMethod            method,
                                                     DualProblem             &problem,
                                                     const ContactConstraint &constraint,
                                                     const ContactTolerance  &tolerance);

  /** The method of this name. @p problem must outlive it. */
  std::unique_ptr<GapOptimiser> make_gap_optimiser(AdhesionMethod          method,
                                                   GapProblem             &problem,
                                                   const GapConstraint    &constraint,
                                                   const ContactTolerance &tolerance);
} // namespace strait

#endif
