// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_earlier_results_h
#define strait_run_earlier_results_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/run/folder_lock.h>

#include <mpi.h>

#include <memory>
#include <string>

namespace strait
{
  /** What is in a file; nothing if there is none. */
  std::string text_of(const std::string &path);

  /**
   * In what two resolved scenes differ, "Contact/Grid points = 512 where the scene now
   * has 64"; empty if in nothing that a number of the results depends on.
   */
  std::string difference_of_scenes(const std::string &then, const std::string &now);

  /**
   * Throws InputError on all ranks if the output directory of @p scene holds results of
   * another scene, or of one that cannot be told. Collective.
   */
  void refuse_results_of_another_scene(const Scene &scene, MPI_Comm comm);

  /**
   * Make the output directory of @p scene, unless the run is @p resumed remove the
   * results of an earlier one from it, and only those, so that a folder never mixes two
   * runs, and begin with the log and parameters.prm. Returns on rank 0 the lock of the
   * folder, to be held until the last result is written. Collective. Throws on all ranks:
   * InputError, before anything is touched, if another run holds the lock, or if the
   * folder cannot be made or written to; ComputationError if the disk is full.
   */
  [[nodiscard]] std::unique_ptr<const FolderLock>
  begin_results(const Scene &scene, MPI_Comm comm, Log &log, bool resumed);
} // namespace strait

#endif
