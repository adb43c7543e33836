// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_step_report_h
#define strait_run_step_report_h

#include <strait/base/log.h>
#include <strait/run/step.h>

namespace strait
{
  /** On the live line, the step that begins and how long it and those after it may take
   *  if each takes @p seconds_each; 0: that is not known. */
  void announce_step(int number, int n_steps, double seconds_each, Log &log);

  /** A line on a step that is done. */
  void report_step(const Step &step, int n_steps, Log &log);
} // namespace strait

#endif
