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
   * With @p resume, continue the run in the output directory from its last complete step.
   * Throws InputError, before anything is written, if its checkpoint cannot be used.
   */
  RunSummary simulate(const Scene &scene,
                      Log         &log,
                      bool         resume = false,
                      MPI_Comm     comm   = MPI_COMM_WORLD);

  /**
   * Run @p scene for each of its realisations, or once if it has no section Realisations.
   * doc/results.md describes the files in the output directory and its subfolders. A
   * realisation that fails, as without a threshold, says so in its row and does not stop
   * the others. The rows of realisations that run at the same time are in the order of
   * the scene. With @p resume, realisations that are done are not run again. Collective.
   *
   * @return whether all steps of all realisations converged. Throws Interruption if a
   * signal stopped one.
   */
  bool run_all_realisations(const Scene &scene, Log &log, bool resume = false);

  /** Check @p scene as simulate() would before it computes anything but the surface.
   *  Throws InputError. Collective. */
  void check_input(const Scene &scene, Log &log);

  /** Do what check_input() does, and print sizes, memory, resolution warnings and active
   *  effects. Collective. */
  void describe(const Scene &scene, Log &log);

  /** Predict, in a line for the screen, what will limit the accuracy of the leak rate.
   *  Computes nothing, but relies on the throats of comparable runs (doc/accuracy.md,
   *  doc/paper.md). @p rms_slope is that of the heights; the critical load of a rough
   *  surface scales with it. */
  std::string limiting_error(const Scene &scene, double rms_slope);
} // namespace strait
