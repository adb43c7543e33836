// SPDX-License-Identifier: GPL-2.0-or-later
// All tables, those of scripts included, and the reference that is printed of them.
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/base/units.h>
#include <strait/run/result_tables.h>

#include <initializer_list>

namespace strait
{
  namespace
  {
    /** Describe a table that a script writes; its columns have no entries here. */
    TableInfo
    made_by_script(const std::string                         &file,
                   const Condition                           &condition,
                   const std::string                         &definition,
                   const std::initializer_list<const char *> &columns)
    {
      TableFile table(file, condition, definition);
      for (const char *column : columns)
        table.declare(column);
      return table.info();
    }

    /** Exponents of leak rate and throat against the reduced load. */
    TableInfo
    fit_table(const Scene &scene)
    {
      return made_by_script(
        "fit.csv",
        with_threshold(scene),
        "Exponents with which leak rate and throat depend on ε = 1 − L/L_c.",
        {"quantity: `leak_rate`, `throat_gap`, `throat_length` or `throat_width`",
         "slip_length [length]: slip length d0",
         ("kind: `local`: slope between neighbouring steps; `fit`: least squares over "
          "the steps with `status` ok up to `Largest reduced load of fits`"),
         "from [1]: smallest ε of the steps",
         "to [1]: largest ε",
         "exponent [1]: exponent β of quantity ∝ ε^β",
         "error [1]: standard error of the fit; 0 for two steps",
         "points [1]: number of steps",
         ("closing_law [1]: for a local exponent, the value by the law of closing, whose "
          "one constant is fitted to those of the leak rate up to `Largest reduced load "
          "of fits`, see [theory.md](theory.md); `nan` with `Rarefaction` or `Adhesion`, "
          "for which there is no such law"),
         "status: `ok`, or the words of `status` in leakage.csv of all steps used"});
    }

    /** How quantities scatter over the realisations. */
    TableInfo
    ensemble_summary_table(const Scene &scene)
    {
      return made_by_script(
        "ensemble_summary.csv",
        {"with the section `Realisations` and `Load programme/Find threshold`",
         scene.realisations.enabled() && scene.programme.find_threshold},
        "One row for each quantity.",
        {("quantity: `critical_load` (the middle of its bracket), "
          "`crossover_reduced_load` (ε_x), or a column of ensemble.csv"),
         "mean [of the quantity]: mean over the realisations",
         ("standard_deviation [of the quantity]: standard deviation over the "
          "realisations; `nan` for a single one"),
         "samples [1]: number of realisations for which the quantity is known",
         ("missing [1]: number of those for which it is not; `status` in ensemble.csv "
          "tells why, or `Reduced loads` has too few steps for it")});
    }

    /** The leak rate of the whole seal, from the realisations. */
    TableInfo
    seal_table(const Scene &scene)
    {
      return made_by_script(
        "seal.csv",
        {"with `Seal/Enabled`", scene.seal.enabled},
        ("The leak rate of the whole seal, one row for each load whose pressures over "
         "the width are covered by those of the patches; see [seal.md](seal.md)."),
        {"pressure [pressure]: nominal pressure, the mean over the width",
         ("leak_rate_median [of the column unit]: median leak rate: as likely exceeded "
          "as not"),
         ("leak_rate_5_percent [of the column unit]: leak rate exceeded with a "
          "probability of 95 %"),
         ("leak_rate_95_percent [of the column unit]: leak rate exceeded with a "
          "probability of 5 %"),
         ("unit: unit of the leak rates: the first of `Output/Leak rate units`, or that "
          "of the scene; empty if that states none"),
         "sealed [1]: fraction of the seals that do not leak",
         ("scatter_patches [1]: standard deviation of ln Q that more patches would "
          "reduce"),
         ("scatter_arrangement [1]: standard deviation of ln Q between seals of this "
          "size and surface, which nothing reduces"),
         ("solution_error [1]: mean relative error of the leak rates of the patches that "
          "leak: `leak_rate_error` where it is known, else the distance to the farther "
          "of their bounds")});
    }

    /** The load for the wanted leak rate of the whole seal. */
    TableInfo
    seal_load_table(const Scene &scene)
    {
      return made_by_script(
        "seal_load.csv",
        {"with `Seal/Wanted leak rate`",
         scene.seal.enabled && scene.seal.wanted_leak_rate > 0.},
        ("The load at which the whole seal leaks as wanted; `nan` where it lies beyond "
         "the loads of seal.csv."),
        {"wanted_leak_rate [of the column unit]: value of `Seal/Wanted leak rate`",
         "unit: unit of the leak rate, as in seal.csv",
         "load [pressure]: load at which the median leak rate is as wanted",
         "load_5_percent [pressure]: load at which the 5 % quantile is as wanted",
         ("load_95_percent [pressure]: load at which the 95 % quantile is: enough with a "
          "probability of 95 %")});
    }
  } // namespace

  std::vector<TableInfo>
  all_tables(const Scene &scene)
  {
    return {leakage_table(scene).info(),
            threshold_table(scene).info(),
            constriction_table(scene).info(),
            fit_table(scene),
            blow_out_table(scene).info(),
            jump_table(scene).info(),
            relaxation_table(scene).info(),
            ensemble_table(scene).info(),
            ensemble_summary_table(scene),
            seal_table(scene),
            seal_load_table(scene),
            spectrum_table(scene).info()};
  }

  void
  print_columns(std::ostream &out, const std::string &format)
  {
    require(format == "md", "--columns " + format + ": the format is md.");
    Scene scene; // with all columns whose names come from a scene
    scene.output.leak_rate_units = split(names_in(leak_rate_units), ',');
    for (const TableInfo &table : all_tables(scene))
      print_markdown(out, table);
  }
} // namespace strait
