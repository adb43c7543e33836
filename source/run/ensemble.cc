// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/signals.h>
#include <strait/base/text.h>
#include <strait/run/disk_space.h>
#include <strait/run/earlier_results.h>
#include <strait/run/ensemble.h>
#include <strait/run/output_directory.h>
#include <strait/run/result_tables.h>
#include <strait/run/run_state.h>
#include <strait/run/scripts.h>
#include <strait/run/simulation.h>
#include <strait/surface/read_scene.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

namespace strait
{
  namespace
  {
    struct Realisation
    {
      unsigned long long seed;
      Orientation        orientation;
    };

    std::vector<Realisation>
    list_realisations(const Scene &scene)
    {
      std::vector<unsigned long long> seeds = scene.realisations.seeds;
      if (seeds.empty())
        seeds.push_back(scene.surface.seed);
      std::vector<Realisation> all;
      for (const unsigned long long seed : seeds)
        for (const Orientation orientation : scene.realisations.orientations)
          all.push_back({seed, orientation});
      return all;
    }

    std::string
    yes_or_no(const bool value)
    {
      return value ? "true" : "false";
    }

    /** What makes the scene file this realisation alone. */
    Overrides
    overrides_of(const Realisation &realisation,
                 const std::string &directory,
                 const bool         two_in_a_row)
    {
      const bool inverted = realisation.orientation == Orientation::inverted ||
                            realisation.orientation == Orientation::inverted_and_rotated;
      const bool rotated = realisation.orientation == Orientation::rotated ||
                           realisation.orientation == Orientation::inverted_and_rotated;
      return {"Surface/Seed=" + std::to_string(realisation.seed),
              "Surface/Invert=" + yes_or_no(inverted),
              "Surface/Rotate=" + yes_or_no(rotated),
              "Realisations/Seeds=",
              "Realisations/Orientations=" + name_of(Orientation::as_is),
              "Seal/Enabled=false",
              "Seal/Two in a row=" + yes_or_no(two_in_a_row),
              "Output/Directory=" + directory};
    }

    RealisationRow
    row_of(const std::size_t  number,
           const Realisation &realisation,
           const RunSummary  &run,
           const std::string &status)
    {
      Transition threshold;
      threshold.lower = threshold.upper = threshold.contact_area = std::nan("");
      if (!run.thresholds.empty())
        threshold = run.thresholds.front();
      const double load = threshold.middle();
      return {static_cast<int>(number),
              realisation.seed,
              name_of(realisation.orientation),
              threshold.lower,
              threshold.upper,
              threshold.contact_area,
              (1 - run.crossover) * load,
              std::isnan(load) ? load : run.crossover,
              (1 - run.theory_crossover) * load,
              run.exponent.n_points < 2 ? std::nan("") : run.exponent.exponent,
              run.exponent.n_points < 2 ? std::nan("") : run.exponent.error,
              status,
              run.validity};
    }

    /** Mean and standard deviation of what the scene looks for. */
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
      add("contact_area", &Row::contact_area);
      add("critical_load", [](const Row &row) { return .5 * (row.lower + row.upper); });
      add("crossover_load", &Row::crossover_load);
      add("crossover_reduced_load", &Row::crossover_reduced_load);
      add("exponent", &Row::exponent);
      if (scene.theory.enabled)
        add("theory_crossover_load", &Row::theory_crossover_load);
      return rows;
    }

    /** The same on all ranks. */
    bool
    has_checkpoint(const Scene &scene)
    {
      std::string found;
      run_on_root(MPI_COMM_WORLD, [&]() {
        if (std::filesystem::exists(scene.output.directory + "/checkpoint"))
          found = "yes";
      });
      return !broadcast(MPI_COMM_WORLD, found).empty();
    }

    [[noreturn]] void
    throw_interruption(const Scene &scene)
    {
      throw Interruption(
        "Stopped by " + name_of_stop_signal() +
        " after a complete step or solve of a search; " +
        (scene.output.checkpoint
           ? "the same command with --resume continues."
           : "with Output/Checkpoint = true it could have been resumed."));
    }
  } // namespace

  bool
  run_all_realisations(const std::string &path,
                       const Overrides   &overrides,
                       const Scene       &scene,
                       Log               &log,
                       const bool         resume)
  {
    if (!scene.realisations.enabled())
      {
        const RunSummary run = simulate(scene, log, resume);
        if (run.stopped)
          throw_interruption(scene);
        return run.converged;
      }

    const std::string folder = scene.output.directory;
    const RunState    state(scene, MPI_COMM_WORLD, resume);
    if (!resume)
      prepare_directory(folder, MPI_COMM_WORLD);
    log.attach_file(folder + "/log.txt", resume);
    state.save_end({}); // that it is these realisations
    Table<RealisationRow> table = ensemble_table(scene);
    run_on_root(MPI_COMM_WORLD, [&]() {
      table.open(folder + "/ensemble.csv");
      write_text(folder + "/parameters.prm", scene.resolved);
    });

    bool                           all_converged = true;
    const std::vector<Realisation> realisations  = list_realisations(scene);
    std::vector<RealisationRow>    rows;
    for (const Realisation &realisation : realisations)
      {
        const std::string number = std::to_string(rows.size() + 1);
        log.line("realisation " + number + " of " + std::to_string(realisations.size()) +
                 ": seed " + std::to_string(realisation.seed) + ", " +
                 name_of(realisation.orientation));
        Overrides all = overrides;
        for (const std::string &own :
             overrides_of(realisation,
                          folder + "/realisation-" + number,
                          scene.seal.two_in_a_row || scene.has_patches_in_a_row()))
          all.push_back(own);
        const Scene alone = read_scene(path, all);
        Log         own_log(MPI_COMM_WORLD, log.is_quiet());
        RunSummary  run;
        std::string status = "ok";
        try
          {
            run = simulate(alone, own_log, resume && has_checkpoint(alone));
            if (!run.converged)
              status = "not-converged";
            add_words(status, run.status);
          }
        catch (const ComputationError &error)
          {
            // The same on all ranks, so they go on together.
            log.warn(error.what());
            status = "failed";
          }
        if (run.stopped)
          throw_interruption(scene);
        all_converged = all_converged && status != "failed" && run.converged;
        rows.push_back(row_of(rows.size() + 1, realisation, run, status));
        run_on_root(MPI_COMM_WORLD, [&]() {
          table.append(rows.back());
          ensemble_summary_table(scene).write_rows(folder + "/ensemble_summary.csv",
                                                   scatter_of(rows, scene));
        });
      }
    for (const ScatterRow &row : scatter_of(rows, scene))
      if (row.n_missing > 0)
        log.warn(
          format("%s is known of %zu of %zu realisations; the column status of "
                 "ensemble.csv tells why, or Load programme/Reduced loads has too few "
                 "steps for it",
                 row.quantity.c_str(),
                 row.n_samples,
                 rows.size()));
    run_on_root(MPI_COMM_WORLD, [&]() {
      if (scene.seal.enabled)
        assess_whole_seal(scene, log);
      draw_results(scene, log);
    });
    return all_converged;
  }
} // namespace strait
