// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_output_directory_h
#define strait_run_output_directory_h

#include <strait/base/collective.h>
#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/run/folder_lock.h>
#include <strait/run/result_tables.h>
#include <strait/run/run_summary.h>
#include <strait/run/scaling.h>
#include <strait/run/step.h>

#include <memory>
#include <string>
#include <vector>

namespace strait
{
  /**
   * The folder of one run: tables, fields, pictures, log and record. While it lives no
   * other run can write there.
   */
  class OutputDirectory
  {
  public:
    /** Collective. Throws on all ranks what begin_results() does. With @p resumed the
     *  folder stays as it is until transfer() restores the tables. @p scene must outlive
     *  this object. */
    OutputDirectory(const Scene &scene, MPI_Comm comm, Log &log, bool resumed = false);

    /** The tables so far; those on the disk may have rows of steps that were not
     *  completed. Collective. */
    void transfer(StateArchive &archive);

    /** Write a whole table to its file. Collective. */
    template <typename Row>
    void
    write_table(Table<Row> whole, const std::vector<Row> &rows) const
    {
      run_on_root(comm,
                  [&]() { whole.write_rows(path + "/" + whole.info().file, rows); });
    }

    /** Write a row, and fields and picture data as the scene asks. Collective. */
    void write(const Step &step, bool is_last);

    /**
     * Write run.json and draw the pictures. Collective. @p bytes_per_point is the most
     * memory so far per grid point.
     */
    void finish(const Timers &timers, double bytes_per_point);

    /** Complete @p summary with what @p thresholds and steps leave. */
    void summarise(const std::vector<Transition> &thresholds, RunSummary &summary) const;

  private:
    const Scene &scene;
    MPI_Comm     comm;
    Log         &log;
    std::string  path;

    std::unique_ptr<const FolderLock> lock; // on rank 0, until the tables are closed

    Table<Step> table, constrictions;
    Scaling     scaling;

    std::vector<std::string> error_budget; // JSON, of the steps so far
    std::vector<std::string> validity;     // likewise

    std::string words_of_status = "ok", words_of_validity = "ok"; // of the steps so far
  };
} // namespace strait

#endif
