// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/csv_file.h>
#include <strait/base/exceptions.h>
#include <strait/base/signals.h>
#include <strait/driver/ensemble.h>
#include <strait/driver/output_directory.h>
#include <strait/driver/run_state.h>
#include <strait/driver/simulation.h>

#include <cmath>
#include <filesystem>
#include <map>
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
    overrides_of(const Realisation &realisation, const std::string &directory)
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

    /** Mean and standard deviation of what a quantity was in each realisation. */
    class Scatter
    {
    public:
      void
      add(const std::string &quantity, const double value)
      {
        if (std::isfinite(value))
          values[quantity].push_back(value);
      }

      void
      write(const std::string &path) const
      {
        CsvFile file;
        file.open(path, {"quantity", "mean", "standard_deviation", "samples"});
        for (const auto &[quantity, samples] : values)
          {
            const auto n    = static_cast<double>(samples.size());
            double     mean = 0, square = 0;
            for (const double value : samples)
              mean += value / n;
            for (const double value : samples)
              square += (value - mean) * (value - mean);
            file.append({quantity,
                         full_precision(mean),
                         full_precision(n > 1 ? std::sqrt(square / (n - 1)) : 0.),
                         std::to_string(samples.size())});
          }
      }

    private:
      std::map<std::string, std::vector<double>> values;
    };

    /** The columns of ensemble.csv; that of the theory stands before the last. */
    const std::vector<std::string> ensemble_columns = {"realisation",
                                                       "seed",
                                                       "orientation",
                                                       "critical_load_lower",
                                                       "critical_load_upper",
                                                       "contact_area",
                                                       "crossover_load",
                                                       "exponent",
                                                       "exponent_error",
                                                       "status"};
    const std::string              theory_column    = "theory_crossover_load";

    /** The row of one realisation; its numbers are added to @p scatter. */
    std::vector<std::string>
    ensemble_row(const int          number,
                 const Realisation &realisation,
                 const bool         with_theory,
                 const RunSummary  &run,
                 const std::string &status,
                 Scatter           &scatter)
    {
      Transition threshold;
      threshold.lower = threshold.upper = threshold.contact_area = std::nan("");
      if (!run.thresholds.empty())
        threshold = run.thresholds.front();
      const double crossover = (1 - run.crossover) * threshold.middle();
      const double exponent =
        run.exponent.n_points < 2 ? std::nan("") : run.exponent.exponent;
      scatter.add("critical_load", threshold.middle());
      scatter.add("contact_area", threshold.contact_area);
      scatter.add("crossover_load", crossover);
      scatter.add("crossover_reduced_load", run.crossover);
      scatter.add("exponent", exponent);
      std::vector<std::string> row = {std::to_string(number),
                                      std::to_string(realisation.seed),
                                      name_of(realisation.orientation),
                                      full_precision(threshold.lower),
                                      full_precision(threshold.upper),
                                      full_precision(threshold.contact_area),
                                      full_precision(crossover),
                                      full_precision(exponent),
                                      full_precision(run.exponent.error),
                                      status};
      if (with_theory)
        {
          const double load = (1 - run.theory_crossover) * threshold.middle();
          scatter.add(theory_column, load);
          row.insert(row.end() - 1, full_precision(load));
        }
      return row;
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

    const std::vector<Realisation> realisations = list_realisations(scene);
    const std::string              folder       = scene.output.directory;
    const RunState                 state(scene, MPI_COMM_WORLD, resume);
    if (!resume)
      prepare_directory(folder, MPI_COMM_WORLD);
    log.attach_file(folder + "/log.txt", resume);
    state.save_end({}); // that it is these realisations
    std::vector<std::string> columns = ensemble_columns;
    if (scene.theory.enabled)
      columns.insert(columns.end() - 1, theory_column);
    CsvFile table;
    run_on_root(MPI_COMM_WORLD, [&]() {
      table.open(folder + "/ensemble.csv", columns);
      write_text(folder + "/parameters.prm", scene.resolved);
    });

    bool    all_converged = true;
    Scatter scatter;
    for (std::size_t k = 0; k < realisations.size(); ++k)
      {
        const auto number = static_cast<int>(k) + 1;
        log.line("realisation " + std::to_string(number) + " of " +
                 std::to_string(realisations.size()) + ": seed " +
                 std::to_string(realisations[k].seed) + ", " +
                 name_of(realisations[k].orientation));
        Overrides all = overrides;
        for (const std::string &own :
             overrides_of(realisations[k],
                          folder + "/realisation-" + std::to_string(number)))
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
          }
        catch (const ComputationError &error)
          {
            // The same on all ranks, so they go on together.
            log.warn(error.what());
            status = "failed";
          }
        if (run.stopped)
          throw_interruption(scene);
        all_converged  = all_converged && status == "ok";
        const auto row = ensemble_row(
          number, realisations[k], scene.theory.enabled, run, status, scatter);
        run_on_root(MPI_COMM_WORLD, [&]() {
          table.append(row);
          scatter.write(folder + "/ensemble_summary.csv");
        });
      }
    if (scene.output.pictures)
      run_on_root(MPI_COMM_WORLD, [&]() { draw_pictures(folder, log); });
    return all_converged;
  }
} // namespace strait
