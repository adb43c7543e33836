// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/signals.h>
#include <strait/driver/ensemble.h>
#include <strait/driver/output_directory.h>
#include <strait/driver/result_tables.h>
#include <strait/driver/run_state.h>

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    std::vector<RealisationRow>
    list_realisations(const Scene &scene)
    {
      std::vector<unsigned long long> seeds = scene.realisations.seeds;
      if (seeds.empty())
        seeds.push_back(scene.surface.seed);
      std::vector<RealisationRow> all;
      for (const unsigned long long seed : seeds)
        for (const Orientation orientation : scene.realisations.orientations)
          all.push_back({static_cast<int>(all.size()) + 1, seed, orientation, {}, "ok"});
      return all;
    }

    std::string
    yes_or_no(const bool value)
    {
      return value ? "true" : "false";
    }

    /** What makes the scene file this realisation alone. */
    Overrides
    overrides_of(const RealisationRow &realisation, const std::string &directory)
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
              "Output/Directory=" + directory};
    }

    /** Mean and standard deviation of a quantity over the realisations that know it. */
    template <typename Value>
    ScatterRow
    scatter_of(const std::string                 &quantity,
               const Value                        value,
               const std::vector<RealisationRow> &realisations)
    {
      std::vector<double> samples;
      for (const RealisationRow &row : realisations)
        if (std::isfinite(std::invoke(value, row)))
          samples.push_back(std::invoke(value, row));
      const auto n    = static_cast<double>(samples.size());
      double     mean = 0, square = 0;
      for (const double sample : samples)
        mean += sample / n;
      for (const double sample : samples)
        square += (sample - mean) * (sample - mean);
      return {quantity, mean, n > 1 ? std::sqrt(square / (n - 1)) : 0., samples.size()};
    }

    /** The scatter of all quantities that any of the realisations knows. */
    std::vector<ScatterRow>
    scatter_of(const std::vector<RealisationRow> &realisations)
    {
      std::vector<ScatterRow> rows;
      const auto              add = [&](const char *quantity, const auto value) {
        ScatterRow row = scatter_of(quantity, value, realisations);
        if (row.n_samples > 0)
          rows.push_back(std::move(row));
      };
      using Row = RealisationRow;
      add("contact_area", [](const Row &row) { return row.threshold().contact_area; });
      add("critical_load",
          [](const Row &row) { return row.threshold().critical_load(); });
      add("crossover_load", &Row::crossover_load);
      add("crossover_reduced_load", &Row::crossover_reduced_load);
      add("exponent", &Row::exponent);
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

  Threshold
  RealisationRow::threshold() const
  {
    if (!run.thresholds.empty())
      return run.thresholds.front();
    Threshold unknown;
    unknown.lower = unknown.upper = unknown.contact_area = std::nan("");
    return unknown;
  }

  double
  RealisationRow::exponent() const
  {
    return run.exponent.n_points < 2 ? std::nan("") : run.exponent.exponent;
  }

  double
  RealisationRow::crossover_reduced_load() const
  {
    return run.thresholds.empty() ? std::nan("") : run.crossover;
  }

  double
  RealisationRow::crossover_load() const
  {
    return (1 - run.crossover) * threshold().critical_load();
  }

  double
  RealisationRow::theory_crossover_load() const
  {
    return (1 - run.theory_crossover) * threshold().critical_load();
  }

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

    bool                              all_converged = true;
    const std::vector<RealisationRow> planned       = list_realisations(scene);
    std::vector<RealisationRow>       done;
    for (RealisationRow realisation : planned)
      {
        const std::string number = std::to_string(realisation.number);
        log.line("realisation " + number + " of " + std::to_string(planned.size()) +
                 ": seed " + std::to_string(realisation.seed) + ", " +
                 name_of(realisation.orientation));
        Overrides all = overrides;
        for (const std::string &own :
             overrides_of(realisation, folder + "/realisation-" + number))
          all.push_back(own);
        const Scene alone = read_scene(path, all);
        Log         own_log(MPI_COMM_WORLD, log.is_quiet());
        try
          {
            realisation.run = simulate(alone, own_log, resume && has_checkpoint(alone));
            if (!realisation.run.converged)
              realisation.status = "not-converged";
          }
        catch (const ComputationError &error)
          {
            // The same on all ranks, so they go on together.
            log.warn(error.what());
            realisation.status = "failed";
          }
        if (realisation.run.stopped)
          throw_interruption(scene);
        all_converged = all_converged && realisation.status == "ok";
        done.push_back(realisation);
        run_on_root(MPI_COMM_WORLD, [&]() {
          table.append(realisation);
          ensemble_summary_table(scene).write_rows(folder + "/ensemble_summary.csv",
                                                   scatter_of(done));
        });
      }
    if (scene.output.pictures)
      run_on_root(MPI_COMM_WORLD, [&]() { draw_pictures(folder, log); });
    return all_converged;
  }
} // namespace strait
