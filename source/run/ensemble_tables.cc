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
    table
      .add(&RealisationRow::number,
           "realisation [1]: number k of the realisation, from 1")
      .add(&RealisationRow::seed, "seed [1]: its `Surface/Seed`")
      .add([](const RealisationRow &row) { return name_of(row.orientation); },
           "orientation: how the surface is turned")
      .add([](const RealisationRow &row) { return row.threshold.lower; },
           "critical_load_lower [pressure]: largest load known to leak, at the first "
           "slip length")
      .add([](const RealisationRow &row) { return row.threshold.upper; },
           "critical_load_upper [pressure]: smallest load known to seal, likewise")
      .add([](const RealisationRow &row) { return row.threshold.contact_area; },
           "contact_area [1]: fraction in contact at `critical_load_lower`")
      .add(not_yet,
           "crossover_load [pressure]: load (1 − ε_x) L_c at which the exponential decay "
           "far from the threshold turns into the power law, at the slip length nearest "
           "to zero, see below; `nan` if the decay is too slow for that, or the power is "
           "another")
      .add(not_yet,
           "exponent [1]: exponent of the leak rate at the slip length nearest to zero")
      .add(not_yet, "exponent_error [1]: standard error of the fit of `exponent`")
      .when({"with `Theory/Enabled`", scene.theory.enabled})
      .add(not_yet,
           "theory_crossover_load [pressure]: crossover load of the theory's leak rate "
           "at the same steps; `nan` likewise")
      .when()
      .add(
        &RealisationRow::status,
        "status: `ok`, `failed`, or the words of `status` of all its rows of "
        "leakage.csv, after `not-converged` if these are failures of solvers. "
        "`no-exponent` or `no-crossover` is added if fewer than two of the steps needed "
        "for it are resolved; `no-crossover` also if the decay is too slow for a "
        "crossover or the power is not 69/20")
      .add(&RealisationRow::validity,
           "validity: `ok`, or the words of `validity` of all its rows");
    return table;
  }
} // namespace strait
