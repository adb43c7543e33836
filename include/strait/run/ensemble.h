// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_ensemble_h
#define strait_run_ensemble_h

#include <strait/base/log.h>
#include <strait/base/scene.h>

#include <string>

namespace strait
{
  /**
   * Run the scene file @p path with @p overrides, which @p scene is made of, for each
   * of its realisations, or once if it has no section Realisations.
   *
   * Realisation k leaves its results in the folder realisation-k of the output
   * directory, together with a parameters.prm that repeats it alone. The table
   * ensemble.csv gets one row for each, at once when it is done, and
   * ensemble_summary.csv the mean and the scatter. A realisation whose threshold is
   * not found says so in its row and does not stop the others. Collective.
   *
   * Groups of Realisations/Ranks each ranks run as many realisations at the same time as
   * there are groups; the rows come in the order of the scene when all of these are done.
   *
   * With @p resume, realisations that are done are not run again, and one that was
   * interrupted is continued.
   *
   * @return whether all steps of all realisations converged. Throws Interruption if a
   * signal stopped them.
   */
  bool run_all_realisations(const std::string &path,
                            const Overrides   &overrides,
                            const Scene       &scene,
                            Log               &log,
                            bool               resume = false);
} // namespace strait

#endif
