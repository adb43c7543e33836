// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_ensemble_tables_h
#define strait_run_ensemble_tables_h

#include <strait/base/scene.h>
#include <strait/base/table.h>
#include <strait/run/run_summary.h>

#include <string>
#include <vector>

/** The tables of realisations and of the seal that they are patches of. */
namespace strait
{
  /** One surface of several, and what came of it: a row of ensemble.csv. */
  struct RealisationRow : RunSummary
  {
    int                number = 0; // from 1
    unsigned long long seed   = 0;
    std::string        orientation;

    double
    crossover_load() const
    {
      return (1 - crossover) * critical_load();
    }
    double
    theory_crossover_load() const
    {
      return (1 - theory_crossover) * critical_load();
    }
  };

  /** How a quantity scatters over the realisations: a row of ensemble_summary.csv. */
  struct ScatterRow
  {
    std::string quantity;
    double      mean               = 0.;
    double      standard_deviation = 0.;
    std::size_t n_samples          = 0; // realisations for which it is a finite number
    std::size_t n_missing          = 0; // the others
  };

  /** A row of seal.csv: what a script makes of the realisations. */
  struct SealRow
  {
    double      pressure, median, lower, upper;
    std::string unit;
    double      sealed, of_patches, of_arrangement, of_solution;
  };

  /** The row of seal_load.csv. */
  struct SealLoadRow
  {
    double      wanted, median, lower, upper;
    std::string unit;
  };

  /** ensemble.csv: one row for each realisation. */
  Table<RealisationRow> ensemble_table(const Scene &scene);

  /** ensemble_summary.csv: means and scatter over these. */
  Table<ScatterRow> ensemble_summary_table(const Scene &scene);

  /** Its rows: mean and standard deviation of what @p scene looks for, over
   *  @p realisations. */
  std::vector<ScatterRow> scatter_of(const std::vector<RealisationRow> &realisations,
                                     const Scene                       &scene);

  /** seal.csv: leak rate of the whole seal. */
  Table<SealRow> seal_table(const Scene &scene);

  /** seal_load.csv: the load for a wanted leak rate. */
  Table<SealLoadRow> seal_load_table(const Scene &scene);
} // namespace strait

#endif
