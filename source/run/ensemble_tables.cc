// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/result_tables.h>

#include <cmath>

namespace strait
{
  Table<RealisationRow>
  ensemble_table(const Scene &scene)
  {
    // Results of fits, which a script fills in later.
    const auto            not_yet = [](const RealisationRow &) { return std::nan(""); };
    Table<RealisationRow> table("ensemble.csv",
                                {"with the section `Realisations`",
                                 scene.realisations.enabled()},
                                "One row for each realisation, which has a folder "
                                "`realisation-k` with all other tables.");
    table.add(&RealisationRow::number, "realisation [1]: k, from 1")
      .add(&RealisationRow::seed, "seed [1]: `Surface/Seed`")
      .add([](const RealisationRow &row) { return name_of(row.orientation); },
           "orientation: how the surface is turned")
      .add([](const RealisationRow &row) { return row.threshold.lower; },
           "critical_load_lower [pressure]: at the first slip length")
      .add([](const RealisationRow &row) { return row.threshold.upper; },
           "critical_load_upper [pressure]: likewise")
      .add([](const RealisationRow &row) { return row.threshold.contact_area; },
           "contact_area [1]: likewise")
      .add(not_yet,
           "crossover_load [pressure]: (1 − ε_x) L_c at the smallest slip length, where "
           "the exponential decay far from the threshold turns into the power law, see "
           "below; `nan` if it is too slow for that, or the power is another")
      .add(not_yet, "exponent [1]: of the leak rate at the smallest slip length")
      .add(not_yet, "exponent_error [1]: standard error of its fit")
      .when({"with `Theory/Enabled`", scene.theory.enabled})
      .add(not_yet,
           "theory_crossover_load [pressure]: that of the theory's leak rate at the same "
           "steps; `nan` likewise")
      .when()
      .add(
        &RealisationRow::status,
        "status: `ok`, `failed`, or the words of `status` of all its rows of "
        "leakage.csv, after `not-converged` if these are failures of solvers; and "
        "`no-exponent` or `no-crossover` where fewer than two of the steps that these "
        "take are resolved, or where the decay is too slow for a crossover or the power "
        "is not 69/20")
      .add(&RealisationRow::validity,
           "validity: `ok`, or the words of `validity` of all its rows");
    return table;
  }
} // namespace strait
