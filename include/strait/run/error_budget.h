// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_error_budget_h
#define strait_run_error_budget_h

#include <strait/base/scene.h>
#include <strait/run/coarser_seals.h>
#include <strait/run/step.h>
#include <strait/seal/flow_stage.h>

namespace strait
{
  /**
   * What each stage of the method adds to the uncertainty of the leak rate of a step that
   * leaks, and the parameter that would reduce it. Where its load was named by the
   * distance from the critical load @p counted_from, or null, the leak rate at that
   * distance is what is sought. @p rms_height is that of the surface. Collective.
   *
   * - mesh: half the width of the bracket;
   * - order of gaps: of a rarefied gas, the rest of that half, as its bounds do not know
   *   which gap lies at which pressure;
   * - linear solver: the share of the energy at which it stops;
   * - contact tolerance: the gap is known to the residual times the rms height, the
   *   leak rate to three times that over the narrowest gap.
   *
   * With `Output/Error budget`, and where the contact is solved in windows of finer
   * points:
   * - contact grid: the same step on every second and every fourth point. Where both
   *   leak and the differences shrink, the observed order extrapolates to a spacing
   *   of zero, and the distance to there is the error; else it is the difference. Where
   *   throats have windows every second point is enough, with windows of its own and a
   *   third of the points along throats, so that this is the error of the windows' points
   *   as well, and the difference counts three times. A load that was named by its
   *   distance from the critical load is as far from that of the coarser grid: most of
   *   what a grid does is to shift both;
   * - gap interpolation: bilinear in place of monotone cubic, or the reverse.
   *
   * The last two are found on the mesh of the step, or on one of their own where that
   * changes more than the target accuracy.
   *
   * Near a critical load:
   * - critical load: what half of its bracket's width changes at such a load, by
   *   leak_rate_exponent.
   */
  StepErrors assess_errors(const Step       &step,
                           const Transition *counted_from,
                           const Scene      &scene,
                           double            rms_height,
                           CoarserSeals     &coarser);
} // namespace strait

#endif
