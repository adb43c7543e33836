// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/base/units.h>
#include <strait/driver/leakage_table.h>
#include <strait/driver/result_tables.h>
#include <strait/driver/simulation.h>

#include <cmath>
#include <ostream>

namespace strait
{
  namespace
  {
    Condition
    with_threshold(const Scene &scene)
    {
      return {"with `Load programme/Find threshold`", scene.programme.find_threshold};
    }

    Condition
    with_adhesion(const Scene &scene)
    {
      return {"with adhesion", scene.contact.enabled && scene.contact.adhesion.enabled};
    }

    Condition
    with_realisations(const Scene &scene)
    {
      return {"with the section `Realisations`", scene.realisations.enabled()};
    }

    /** Add columns for the place of the grid point that @p point gives of a row. */
    template <typename Row, typename Point>
    void
    add_place(Table<Row>        &table,
              const Scene       &scene,
              const std::string &what,
              const Point       &point)
    {
      const PeriodicGrid grid = grid_of(scene);
      table
        .add("x [length]",
             what,
             [=](const Row &row) { return std::invoke(point, row).ix * grid.dx(); })
        .add("y [length]", "likewise", [=](const Row &row) {
          return std::invoke(point, row).iy * grid.dy();
        });
    }

    /** Entries of the report on a step's constrictions, and of the throat in it. */
    const auto of_report = [](auto member) {
      return [member](const Step &step) {
        return std::invoke(member, *step.flow->constrictions);
      };
    };
    const auto of_throat = [](auto member) {
      return [member](const Step &step) {
        return std::invoke(member, step.flow->constrictions->throat);
      };
    };

    /** The same of a realisation's first threshold. */
    const auto of_threshold = [](auto member) {
      return [member](const RealisationRow &row) {
        return std::invoke(member, row.threshold());
      };
    };
  } // namespace

  Table<Threshold>
  threshold_table(const Scene &scene)
  {
    Table<Threshold> table("threshold.csv",
                           with_threshold(scene),
                           "One row for each slip length, with what the search cost.");
    table
      .add("critical_load_lower [pressure]",
           "largest load known to leak, a nominal pressure",
           &Threshold::lower)
      .add("critical_load_upper [pressure]",
           "smallest load known to seal",
           &Threshold::upper)
      .add("contact_area [1]",
           "fraction of grid points in contact at the former",
           &Threshold::contact_area);
    add_place(table,
              scene,
              "place of the last constriction at the former",
              &Threshold::last_constriction);
    table.add("slip_length [length]", "d0", &Threshold::slip_length)
      .add("contact_solves [1]", "loads that were tried", &Threshold::n_solves)
      .add("fft_pairs [1]", "of these solves", &Threshold::fft_pairs);
    return table;
  }

  Table<Step>
  constriction_table(const Scene &scene)
  {
    Table<Step> table("constrictions.csv",
                      with_threshold(scene),
                      "One row for each step that leaks: where the pressure drops.");
    table.add("step [1]", "as in leakage.csv", &Step::number)
      .add("pressure [pressure]",
           "nominal pressure",
           [](const Step &step) { return step.contact->nominal_pressure; })
      .add("slip_length [length]", "d0", &Step::slip_length)
      .add("reduced_load [1]", "1 − L/L_c", [](const Step &step) {
        return step.reduced_load.value_or(std::nan(""));
      });
    add_place(table,
              scene,
              "narrowest point of the path of least resistance",
              [](const Step &step) { return step.flow->paths.front().bottleneck; });
    table.add("gap [length]", "g0 of the throat there", of_throat(&Throat::gap))
      .add("length [length]",
           "along the channel, within which the gap doubles",
           of_throat(&Throat::length))
      .add("width [length]",
           "across it, at which the gap would vanish",
           of_throat(&Throat::width))
      .add("points_along [1]",
           "the length in grid spacings",
           of_report(&ConstrictionReport::points_along))
      .add("share_of_worst [1]",
           "largest fraction of the pressure drop at one constriction",
           of_report(&ConstrictionReport::share_of_worst))
      .add("constrictions [1]",
           "how many there are along the path",
           of_report(&ConstrictionReport::n_constrictions))
      .add("constrictions_for_90_percent [1]",
           "how many carry 90 % of the pressure drop",
           of_report(&ConstrictionReport::n_for_90_percent));
    return table;
  }

  Table<FitRow>
  fit_table(const Scene &scene)
  {
    const auto of_fit = [](auto member) {
      return [member](const FitRow &row) { return row.fit.*member; };
    };
    Table<FitRow> table("fit.csv",
                        with_threshold(scene),
                        "Exponents of leak rate and throat against ε = 1 − L/L_c.");
    table
      .add("quantity",
           "`leak_rate`, `throat_gap`, `throat_length` or `throat_width`",
           &FitRow::quantity)
      .add("slip_length [length]", "d0", &FitRow::slip_length)
      .add("kind",
           "`local`: the slope between neighbouring steps; `fit`: least squares over the "
           "steps with `status` ok up to `Largest reduced load of fits`",
           &FitRow::kind)
      .add("from [1]", "smallest ε of the steps", of_fit(&ExponentFit::from))
      .add("to [1]", "largest ε", of_fit(&ExponentFit::to))
      .add("exponent [1]", "β of quantity ∝ ε^β", of_fit(&ExponentFit::exponent))
      .add("error [1]",
           "standard error of the fit; 0 for two steps",
           of_fit(&ExponentFit::error))
      .add("points [1]", "number of steps", of_fit(&ExponentFit::n_points));
    return table;
  }

  Table<BlowOut>
  blow_out_table(const Scene &scene)
  {
    Table<BlowOut> table("blow_out.csv",
                         {"with `Load programme/Find blow-out`",
                          scene.programme.find_blow_out},
                         "One row for each of `Pressures`.");
    table.add("pressure [pressure]", "nominal pressure, the load", &BlowOut::load)
      .add("blow_out_pressure_lower [pressure]",
           "largest inlet pressure known to be held when it is raised at this load",
           &BlowOut::lower)
      .add("blow_out_pressure_upper [pressure]",
           "smallest known to leak; 0 or the outlet's: it leaks by itself",
           &BlowOut::upper)
      .add("contact_area [1]",
           "fraction of grid points in contact at the lower one",
           &BlowOut::contact_area);
    add_place(table, scene, "the point that opens", &BlowOut::constriction);
    table.add("solves [1]", "of contact and flow", &BlowOut::n_solves)
      .when({"with `Find re-sealing`", scene.programme.find_resealing})
      .add(
        "resealing_pressure_lower [pressure]",
        "largest inlet pressure known to be held when it is lowered from where it leaks; "
        "both 0 or the outlet's: the seal stays open",
        [](const BlowOut &found) { return found.resealing->lower; })
      .add("resealing_pressure_upper [pressure]",
           "smallest known to leak then",
           [](const BlowOut &found) { return found.resealing->upper; });
    return table;
  }

  Table<Jump>
  jump_table(const Scene &scene)
  {
    // After a pull-off there is no state.
    const auto after = [](double PathPoint::*value) {
      return [value](const Jump &jump) {
        return jump.is_pull_off ? std::nan("") : jump.after.*value;
      };
    };
    Table<Jump> table("jumps.csv",
                      with_adhesion(scene),
                      "One row for each discontinuity on the way from load to load, "
                      "between the last state before and the first one after.");
    table
      .add(
        "kind",
        "`closing` or `opening` by the change of the contact area, or `pull-off` where "
        "the surfaces part: no state follows, gap and area after it are `nan`",
        [](const Jump &jump) -> std::string {
          return jump.is_pull_off                                     ? "pull-off"
                 : jump.after.contact_area > jump.before.contact_area ? "closing"
                                                                      : "opening";
        })
      .add("pressure_before [pressure]",
           "nominal pressure",
           [](const Jump &jump) { return jump.before.pressure; })
      .add("pressure_after [pressure]",
           "at most `Load programme/Jump tolerance` from it",
           [](const Jump &jump) { return jump.after.pressure; })
      .add("mean_gap_before [length]",
           "as in leakage.csv",
           [](const Jump &jump) { return jump.before.mean_gap; })
      .add("mean_gap_after [length]", "likewise", after(&PathPoint::mean_gap))
      .add("contact_area_before [1]",
           "as in leakage.csv",
           [](const Jump &jump) { return jump.before.contact_area; })
      .add("contact_area_after [1]", "likewise", after(&PathPoint::contact_area))
      .add("dissipated_energy [pressure length]",
           "per area: what the energy falls short of the reversible change, half the sum "
           "of mean gap × change of load at both ends; uncertain by half the difference",
           &Jump::dissipated);
    return table;
  }

  Table<RelaxationStep>
  relaxation_table(const Scene &scene)
  {
    Table<RelaxationStep> table(
      "relaxation-STEP.csv",
      {"with `Contact/Adhesion/Trajectory`", scene.contact.adhesion.write_relaxation},
      "One row for each iteration at the last load of the step.");
    table.add("iteration [1]", "its number", &RelaxationStep::iteration)
      .add("energy [pressure length]", "energy per area", &RelaxationStep::energy)
      .add("residual [1]", "`contact_residual` of leakage.csv", &RelaxationStep::residual)
      .add("step [1]",
           "length of the step along its direction; for GFMD of time",
           &RelaxationStep::step);
    return table;
  }

  Table<RealisationRow>
  ensemble_table(const Scene &scene)
  {
    Table<RealisationRow> table("ensemble.csv",
                                with_realisations(scene),
                                "One row for each realisation, which has a folder "
                                "`realisation-k` with all other tables.");
    table.add("realisation [1]", "k, from 1", &RealisationRow::number)
      .add("seed [1]", "`Surface/Seed`", &RealisationRow::seed)
      .add("orientation",
           "how the surface is turned",
           [](const RealisationRow &row) { return name_of(row.orientation); })
      .add("critical_load_lower [pressure]",
           "as in threshold.csv, at the first slip length",
           of_threshold(&Threshold::lower))
      .add("critical_load_upper [pressure]", "likewise", of_threshold(&Threshold::upper))
      .add("contact_area [1]", "likewise", of_threshold(&Threshold::contact_area))
      .add("crossover_load [pressure]",
           "(1 − ε_x) L_c, where the exponential decay far from the threshold turns into "
           "the power law, see below",
           &RealisationRow::crossover_load)
      .add("exponent [1]",
           "of the leak rate at the smallest slip length",
           &RealisationRow::exponent)
      .add("exponent_error [1]",
           "standard error of its fit",
           [](const RealisationRow &row) { return row.run.exponent.error; })
      .when({"with `Theory/Enabled`", scene.theory.enabled})
      .add("theory_crossover_load [pressure]",
           "the crossover load of the theory's leak rate",
           &RealisationRow::theory_crossover_load)
      .when()
      .add("status", "`ok`, `not-converged` or `failed`", &RealisationRow::status);
    return table;
  }

  Table<ScatterRow>
  ensemble_summary_table(const Scene &scene)
  {
    Table<ScatterRow> table("ensemble_summary.csv",
                            with_realisations(scene),
                            "One row for each quantity.");
    table
      .add(
        "quantity",
        "`critical_load`, the middle of its bracket, `crossover_reduced_load`, ε_x, or a "
        "column of ensemble.csv",
        &ScatterRow::quantity)
      .add("mean [of the quantity]", "over the realisations", &ScatterRow::mean)
      .add("standard_deviation [of the quantity]",
           "over the realisations",
           &ScatterRow::standard_deviation)
      .add("samples [1]",
           "realisations for which the quantity is known",
           &ScatterRow::n_samples);
    return table;
  }

  Table<SpectrumRow>
  spectrum_table(const Scene &scene)
  {
    Table<SpectrumRow> table(
      "spectrum.csv",
      {"with `Output/Surface spectrum`", scene.output.surface_spectrum},
      "The power spectral density of the surface, one row for each "
      "ring of wave vectors.");
    table
      .add("wave_number [1/length]",
           "q, geometric mean of the ring's limits",
           [](const SpectrumRow &row) { return row.bin.q; })
      .add("wavelength [length]", "2π/q", &SpectrumRow::wavelength)
      .add("density [length⁴]",
           "C(q) = \\|h~\\|² LxLy/(2π)², averaged over directions: ∫d²q C = h_rms²",
           [](const SpectrumRow &row) { return row.bin.density; })
      .add("modes [1]",
           "wave vectors in the ring",
           [](const SpectrumRow &row) { return row.bin.modes; })
      .add("fit [length⁴]",
           "the self-affine law that fits best; `nan` beyond its range",
           &SpectrumRow::law);
    return table;
  }

  std::vector<TableInfo>
  all_tables(const Scene &scene)
  {
    return {leakage_table(scene).info(),
            threshold_table(scene).info(),
            constriction_table(scene).info(),
            fit_table(scene).info(),
            blow_out_table(scene).info(),
            jump_table(scene).info(),
            relaxation_table(scene).info(),
            ensemble_table(scene).info(),
            ensemble_summary_table(scene).info(),
            spectrum_table(scene).info()};
  }

  void
  print_columns(std::ostream &out, const std::string &format)
  {
    if (format != "md")
      throw InputError("--columns " + format + ": the format is md.");
    Scene scene; // with the columns that a scene gives names to
    scene.output.leak_rate_units = split(leak_rate_unit_names(), ',');
    for (const TableInfo &table : all_tables(scene))
      print_markdown(out, table);
  }
} // namespace strait
