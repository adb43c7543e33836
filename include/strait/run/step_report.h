// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_step_report_h
#define strait_run_step_report_h

#include <strait/base/log.h>
#include <strait/run/step.h>

namespace strait
{
  /** A line on a step that is done, and how long the others may take. */
  void report_step(const Step &step, int n_steps, double seconds_so_far, Log &log);
} // namespace strait

#endif
