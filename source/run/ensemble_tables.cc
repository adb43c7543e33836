// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/result_tables.h>

#include <cmath>

namespace strait
{
  namespace
  {
    Condition
    with_realisations(const Scene &scene)
    {
      return {"with the section `Realisations`", scene.realisations.enabled()};
    }
  } // namespace

  Table<RealisationRow>
  ensemble_table(const Scene &scene)
  {
    Table<RealisationRow> table("ensemble.csv",
                                with_realisations(scene),
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
      .add(&RealisationRow::crossover_load,
           "crossover_load [pressure]: (1 − ε_x) L_c at the smallest slip length, where "
           "the exponential decay far from the threshold turns into the power law, see "
           "below; `nan` if it is too slow for that")
      .add(&RealisationRow::exponent,
           "exponent [1]: of the leak rate at the smallest slip length")
      .add(&RealisationRow::exponent_error,
           "exponent_error [1]: standard error of its fit")
      .when({"with `Theory/Enabled`", scene.theory.enabled})
      .add(&RealisationRow::theory_crossover_load,
           "theory_crossover_load [pressure]: that of the theory's leak rate at the same "
           "steps; `nan` likewise")
      .when()
      .add(&RealisationRow::status,
           "status: `ok`, `failed`, or the words of `status` of all its rows of "
           "leakage.csv, after `not-converged` if these are failures of solvers; and "
           "`no-exponent` or `no-crossover` where fewer than two of the steps that these "
           "take are resolved, or where the decay is too slow for a crossover")
      .add(&RealisationRow::validity,
           "validity: `ok`, or the words of `validity` of all its rows");
    return table;
  }

  Table<ScatterRow>
  ensemble_summary_table(const Scene &scene)
  {
    Table<ScatterRow> table("ensemble_summary.csv",
                            with_realisations(scene),
                            "One row for each quantity.");
    table
      .add(&ScatterRow::quantity,
           "quantity: `critical_load`, the middle of its bracket, "
           "`crossover_reduced_load`, ε_x, or a column of ensemble.csv")
      .add(&ScatterRow::mean, "mean [of the quantity]: over the realisations")
      .add(&ScatterRow::standard_deviation,
           "standard_deviation [of the quantity]: over the realisations; `nan` of one")
      .add(&ScatterRow::n_samples,
           "samples [1]: realisations for which the quantity is known")
      .add(
        &ScatterRow::n_missing,
        "missing [1]: those for which it is not; `status` in ensemble.csv tells why, or "
        "`Reduced loads` has too few steps for it");
    return table;
  }

  std::vector<ScatterRow>
  scatter_of(const std::vector<RealisationRow> &realisations, const Scene &scene)
  {
    using Row = RealisationRow;
    std::vector<ScatterRow> rows;
    const auto              add = [&](const char *quantity, const auto value) {
      std::vector<double> samples;
      for (const Row &row : realisations)
        if (std::isfinite(std::invoke(value, row)))
          samples.push_back(std::invoke(value, row));
      const auto n    = static_cast<double>(samples.size());
      double     mean = samples.empty() ? std::nan("") : 0., square = 0;
      for (const double sample : samples)
        mean += sample / n;
      for (const double sample : samples)
        square += (sample - mean) * (sample - mean);
      rows.push_back({quantity,
                      mean,
                      n > 1 ? std::sqrt(square / (n - 1)) : std::nan(""),
                      samples.size(),
                      realisations.size() - samples.size()});
    };
    if (!scene.programme.find_threshold)
      return rows; // none of them is sought
    add("contact_area", [](const Row &row) { return row.threshold.contact_area; });
    add("critical_load", [](const Row &row) { return row.threshold.middle(); });
    add("crossover_load", &Row::crossover_load);
    add("crossover_reduced_load", &Row::crossover);
    add("exponent", &Row::exponent);
    if (scene.theory.enabled)
      add("theory_crossover_load", &Row::theory_crossover_load);
    return rows;
  }
} // namespace strait
