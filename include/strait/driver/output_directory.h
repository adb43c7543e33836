// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_output_directory_h
#define strait_driver_output_directory_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/driver/result_table.h>
#include <strait/driver/step.h>
#include <strait/driver/threshold_tables.h>

#include <string>

namespace strait
{
  /**
   * The folder of one run: table, fields, pictures, log and record. Opening it
   * removes the results of an earlier run, and only those, so that a folder never
   * mixes two runs.
   */
  class OutputDirectory
  {
  public:
    /** Collective. Throws InputError on all ranks if the folder cannot be made or
     *  written to. @p scene must outlive this object. */
    OutputDirectory(const Scene &scene, MPI_Comm comm, Log &log);

    /** Write threshold.csv. Collective. */
    void write(const std::vector<Threshold> &thresholds);

    /** Write a row, and fields and picture data as the scene asks. Collective. */
    void write(const Step &step, bool is_last);

    /**
     * Write run.json and draw the pictures. Collective. @p bytes_per_point is what
     * contact and bridge hold per grid point.
     */
    void finish(const Timers &timers, double bytes_per_point);

  private:
    void prepare();
    void write_record(const Timers &timers, double bytes_per_point) const;
    void draw_pictures() const;

    const Scene      &scene;
    MPI_Comm          comm;
    Log              &log;
    std::string       path;
    ResultTable       table;
    ConstrictionTable constrictions;
    ScalingTable      scaling;
  };
} // namespace strait

#endif
