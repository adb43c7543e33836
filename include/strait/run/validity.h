// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_validity_h
#define strait_run_validity_h

#include <strait/base/json.h>
#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/run/step.h>

namespace strait
{
  /**
   * Compare @p step with every limit of the model for which @p scene gives what is
   * needed, and warn of those that are passed. doc/validity.md lists the limits with
   * their sources. @p rms_slope is that of the surface. Collective.
   */
  void judge_validity(Step &step, const Scene &scene, double rms_slope, Log &log);

  /** All checks of a step, with their numbers, for run.json. */
  Json validity_record(const Step &step);
} // namespace strait

#endif
