// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_scripts_h
#define strait_run_scripts_h

#include <strait/base/log.h>
#include <strait/base/scene.h>

/** What scripts make of the results in the output directory of a scene. What they say
 *  goes to the log. All functions are for rank 0 only. */
namespace strait
{
  /** Throw InputError if the loads of the patches do not cover what the seal's pressure
   *  profile asks for. Writes nothing. */
  void check_seal_profile(const Scene &scene);

  /** Write seal.csv and seal_load.csv from the results of all realisations. Throws
   *  ComputationError if that fails. */
  void assess_whole_seal(const Scene &scene, Log &log);

  /** Pictures and report.html, as the scene asks; a failure is a warning. */
  void draw_results(const Scene &scene, Log &log);
} // namespace strait

#endif
