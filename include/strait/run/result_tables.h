// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/base/table.h>
#include <strait/run/run_summary.h>
#include <strait/run/step.h>
#include <strait/seal/path.h>
#include <strait/seal/transition_search.h>
#include <strait/surface/statistics.h>

#include <iosfwd>
#include <string>
#include <vector>

/** The tables of a run and of its realisations. Their files, columns, units and
 *  definitions are stated here and nowhere else. */
namespace strait
{
  /** A row of spectrum.csv. */
  struct SpectrumRow : SpectrumBin
  {
    double law = 0.; // density by the self-affine law that fits best
  };

  /** One realisation of several and its result: a row of ensemble.csv. */
  struct RealisationRow : RunSummary
  {
    int                number      = 0; // from 1
    unsigned long long seed        = 0;
    int                orientation = 0;  // see RealisationParameters
    std::string        failure     = {}; // why it failed or was stopped; else empty
    bool               stopped     = false;
  };

  /** leakage.csv, with the columns of the effects that @p scene enables. */
  Table<Step> leakage_table(const Scene &scene);

  /** The condition of tables that need critical loads. */
  Condition with_threshold(const Scene &scene);

  /** threshold.csv: critical loads. */
  Table<Transition> threshold_table(const Scene &scene);

  /** constrictions.csv: where the pressure drops in steps that leak. */
  Table<Step> constriction_table(const Scene &scene);

  /** blow_out.csv: inlet pressures that open the seal. */
  Table<BlowOut> blow_out_table(const Scene &scene);

  /** jumps.csv: where an adhesive contact jumped. */
  Table<Jump> jump_table(const Scene &scene);

  /** relaxation-STEP.csv: iterations of an adhesive contact in a @p step. */
  Table<RelaxationStep> relaxation_table(const Scene       &scene,
                                         const std::string &step = "STEP");

  /** spectrum.csv: power spectral density of the surface. */
  Table<SpectrumRow> spectrum_table(const Scene &scene);

  /** ensemble.csv: one row for each realisation. */
  Table<RealisationRow> ensemble_table(const Scene &scene);

  /** Descriptions of all tables, leakage.csv first. */
  std::vector<TableInfo> all_tables(const Scene &scene);

  /** Print the reference of all tables. Throws InputError if @p format is not "md". */
  void print_columns(std::ostream &out, const std::string &format);
} // namespace strait
