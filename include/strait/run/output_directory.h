// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/run/result_tables.h>
#include <strait/run/run_summary.h>
#include <strait/run/step.h>

#include <memory>
#include <string>
#include <vector>

namespace strait
{
  /** Lock @p folder against other runs while the returned object lives. The lock has no
   *  file, and the system releases it when the process ends, in whatever way. A folder
   *  that does not exist, or whose file system has no locks, is not locked. Throws
   *  InputError if the folder is already locked, by this process or by another. */
  [[nodiscard]] std::shared_ptr<const void> lock_folder(const std::string &folder);

  /** Describe how two resolved scenes differ, as in "Contact/Grid points = 512 where the
   *  scene now has 64"; empty if no number of the results depends on a difference. */
  std::string difference_of_scenes(const std::string &then, const std::string &now);

  /** Throws InputError on all ranks if the output directory of @p scene holds results of
   *  another scene, or of an unknown one. Collective. */
  void refuse_results_of_another_scene(const Scene &scene, MPI_Comm comm);

  /**
   * Prepare the output directory of @p scene, and begin with the log and parameters.prm.
   * Unless the run is @p resumed, make the folder and remove the results of an earlier
   * run from it, and only those, so that a folder never mixes two runs. Returns on rank 0
   * the lock of the folder, to be held until the last result is written. Collective.
   * Throws on all ranks: InputError, before any result is touched, if another run holds
   * the lock or the folder cannot be made or written to; ComputationError if the disk is
   * full.
   */
  [[nodiscard]] std::shared_ptr<const void>
  begin_results(const Scene &scene, MPI_Comm comm, Log &log, bool resumed);

  /** The folder of one run: tables, fields, pictures, log and record. While it lives no
   *  other run can write there. */
  class OutputDirectory
  {
  public:
    /** Collective. Throws on all ranks what begin_results() does. With @p resumed the
     *  tables stay as they are until transfer() restores them. @p scene must outlive this
     *  object. */
    OutputDirectory(const Scene &scene, MPI_Comm comm, Log &log, bool resumed = false);

    /** Save or restore the tables so far. Restoring drops rows of steps that were not
     *  completed from the files. Collective. */
    void transfer(StateArchive &archive);

    /** Write a whole table to its file. Collective. */
    template <typename Row>
    void
    write_table(Table<Row> whole, const std::vector<Row> &rows) const
    {
      run_on_root(comm, [&]() { whole.write_rows(path, rows); });
    }

    /** Write the rows of @p step, and fields and picture data as the scene asks.
     *  Collective. */
    void write(const Step &step, bool is_last);

    /** Write run.json, fit exponents if there are @p thresholds, and draw the pictures.
     *  Returns the summary of the run. @p bytes_per_point is the peak memory so far per
     *  grid point. Collective. */
    RunSummary finish(const std::vector<Transition> &thresholds,
                      const Timers                  &timers,
                      double                         bytes_per_point);

  private:
    const Scene &scene;
    MPI_Comm     comm;
    Log         &log;
    std::string  path;

    std::shared_ptr<const void> lock; // on rank 0, until the tables are closed

    Table<Step> table, constrictions;

    std::vector<std::string> error_budget; // JSON, of the steps so far
    std::vector<std::string> validity;     // likewise

    RunSummary summary; // of the steps so far
  };

  /** Write run.json for all realisations of @p scene together, without what is known of
   *  one run only. For rank 0 only. */
  void write_record_of_ensemble(const Scene &scene, int n_ranks, const Log &log);

  // The following functions run scripts on the results in an output directory. The output
  // of the scripts goes to the log. For rank 0 only.

  /** Write fit.csv for a run in @p folder that looks for the threshold or, for several
   *  realisations, complete ensemble.csv and write ensemble_summary.csv. A failure is a
   *  warning. */
  void fit_results(const std::string &folder, Log &log);

  /** Throw InputError if the loads of the patches do not cover what the seal's pressure
   *  profile asks for. Writes nothing. */
  void check_seal_profile(const Scene &scene);

  /** Write seal.csv and seal_load.csv from the results of all realisations. Throws
   *  ComputationError if that fails. */
  void assess_whole_seal(const Scene &scene, Log &log);

  /** Draw the pictures and write report.html, as the scene asks. A failure is a
   *  warning. */
  void draw_results(const Scene &scene, Log &log);
} // namespace strait
