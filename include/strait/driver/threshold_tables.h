// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_threshold_tables_h
#define strait_driver_threshold_tables_h

#include <strait/base/csv_file.h>
#include <strait/base/log.h>
#include <strait/driver/exponent_fit.h>
#include <strait/driver/step.h>
#include <strait/seal/seal_search.h>
#include <strait/spectral/periodic_grid.h>
#include <strait/spectral/state_archive.h>

#include <map>
#include <string>
#include <vector>

namespace strait
{
  /** Write blow_out.csv: one row for each load. For rank 0 only. */
  void write_blow_outs(const std::string          &path,
                       const std::vector<BlowOut> &blow_outs,
                       const PeriodicGrid         &grid);

  /** Write threshold.csv: one row for each slip length. For rank 0 only. */
  void write_thresholds(const std::string             &path,
                        const std::vector<Transition> &thresholds,
                        const PeriodicGrid            &grid);

  /** The table constrictions.csv: where the pressure drops at each step. */
  class ConstrictionTable
  {
  public:
    /** For rank 0 only, as append(). */
    void open(const std::string &path);

    /** Continue the table in the file @p path. */
    void
    reopen(const std::string &path)
    {
      file.reopen(path);
    }

    /** Writes a row if something leaks at @p step. */
    void append(const Step &step);

  private:
    CsvFile file;
  };

  /**
   * Exponents of leak rate and throat against 1 − L/L_c. Collects the steps, then
   * writes fit.csv: local slopes between neighbouring steps, and for each quantity a
   * fit over all steps with ε up to a largest one. Steps that are in doubt
   * (Step::doubts) or did not converge are left out of the fits.
   */
  class ScalingTable
  {
  public:
    explicit ScalingTable(const double largest_reduced_load)
      : largest(largest_reduced_load)
    {
    }

    /** Add a step, if it has a reduced load. */
    void collect(const Step &step);

    /** All that was collected. Collective. */
    void transfer(StateArchive &archive);

    /** The fit of the leak rate at the smallest slip, and its crossover. */
    ExponentFit leak_rate_fit() const;
    double      crossover() const;

    /** The crossover of what the theory says at the same steps; not a number without. */
    double theory_crossover() const;

    /** Write the table to @p path (on rank 0) and the fits to @p log. Collective. */
    void write(const std::string &path, Log &log, MPI_Comm comm) const;

  private:
    using Series = std::vector<ScalingPoint>;

    struct Quantities
    {
      std::map<std::string, Series> all;     // by name
      std::map<std::string, Series> trusted; // those without a doubt
    };

    /** Of the smallest slip length; null if there are none. */
    const Series *leak_rates(std::map<std::string, Series> Quantities::*which) const;

    double                       largest;
    std::map<double, Quantities> by_slip_length;
    std::map<double, Series>     theory; // leak rate by slip length
  };
} // namespace strait

#endif
