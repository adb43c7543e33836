// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/run/run_summary.h>

#include <mpi.h>

#include <string>

namespace strait
{
  /**
   * Run @p scene, without its section Realisations, on the ranks of @p comm and write its
   * results to the output directory. Collective. Throws InputError before anything is
   * written if the scene's input is bad, ComputationError if no threshold is found, and
   * Interruption if a signal stopped it.
   *
   * With @p resume the run in the output directory is continued from its last complete
   * step; InputError, before anything is written, if its checkpoint does not serve.
   */
  RunSummary simulate(const Scene &scene,
                      Log         &log,
                      bool         resume = false,
                      MPI_Comm     comm   = MPI_COMM_WORLD);

  /**
   * Run @p scene for each of its realisations, or once if it has no section Realisations.
   * What they leave in the output directory and in folders of it doc/results.md tells.
   * One whose threshold is not found says so in its row and does not stop the others; the
   * rows of those that run at the same time come in the order of the scene. With @p
   * resume, realisations that are done are not run again. Collective.
   *
   * @return whether all steps of all realisations converged. Throws Interruption if a
   * signal stopped one.
   */
  bool run_all_realisations(const Scene &scene, Log &log, bool resume = false);

  /** Check @p scene as simulate() would before it computes anything but the surface.
   *  Throws InputError. Collective. */
  void check_input(const Scene &scene, Log &log);

  /** The same, and print sizes, memory, resolution warnings and active effects.
   *  Collective. */
  void describe(const Scene &scene, Log &log);

  /** What will limit the accuracy of a leak rate, without computing anything, in a line
   *  for the screen: from throats of comparable runs (doc/accuracy.md, doc/paper.md). @p
   *  rms_slope is that of the heights, which the threshold of a rough surface scales
   * with.
   */
  std::string limiting_error(const Scene &scene, double rms_slope);
} // namespace strait
