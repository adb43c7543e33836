// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/run/guards.h>
#include <strait/run/output_directory.h>
#include <strait/run/result_tables.h>
#include <strait/run/run_state.h>
#include <strait/run/simulation.h>

#include <algorithm>
#include <filesystem>
#include <type_traits>
#include <vector>

namespace strait
{
  namespace
  {
    /** The ranks of MPI_COMM_WORLD in groups that work at the same time. */
    class RankGroups
    {
    public:
      /** Make groups of @p ranks_each ranks, or one of all ranks if that is empty. Throws
       *  InputError if it does not divide the number of ranks. Collective. */
      explicit RankGroups(const std::vector<int> &ranks_each)
      {
        const int my_rank = rank_in(MPI_COMM_WORLD);
        const int n_ranks = n_ranks_in(MPI_COMM_WORLD);
        n_each            = ranks_each.empty() ? n_ranks : ranks_each.front();
        require(n_ranks % n_each == 0,
                format("Realisations/Ranks each = %d does not divide the number of "
                       "ranks, %d.",
                       n_each,
                       n_ranks));
        number = n_ranks / n_each;
        mine   = my_rank / n_each;
        MPI_Comm_split(MPI_COMM_WORLD, mine, my_rank, &comm);
      }

      ~RankGroups()
      {
        MPI_Comm_free(&comm);
      }

      RankGroups(const RankGroups &)            = delete;
      RankGroups &operator=(const RankGroups &) = delete;

      int      n_each = 1;             // ranks of a group
      int      number = 1;             // of groups
      int      mine   = 0;             // the group of this rank
      MPI_Comm comm   = MPI_COMM_NULL; // of this rank's group
    };

    /** List all realisations, not run yet. */
    std::vector<RealisationRow>
    list_realisations(const Scene &scene)
    {
      std::vector<unsigned long long> seeds = scene.realisations.seeds;
      if (seeds.empty())
        seeds.push_back(scene.surface.seed);
      std::vector<RealisationRow> all;
      for (const unsigned long long seed : seeds)
        for (const int orientation : scene.realisations.orientations)
          all.push_back({{}, static_cast<int>(all.size() + 1), seed, orientation});
      return all;
    }

    /** Return the scene of one realisation of @p scene alone. */
    Scene
    scene_of(const RealisationRow &realisation, const Scene &scene)
    {
      const bool              is_inverted = (realisation.orientation & 1) != 0;
      const bool              turns       = is_rotated(realisation.orientation);
      std::vector<SceneEntry> entries     = scene.entries;
      const auto set = [&entries](const std::string &name, const std::string &value) {
        entries.push_back(lex_override(name + "=" + value, ""));
      };
      const auto yes_or_no = [](const bool value) { return value ? "true" : "false"; };
      set("Surface/Seed", std::to_string(realisation.seed));
      set("Surface/Invert", yes_or_no(is_inverted));
      set("Surface/Rotate", yes_or_no(turns));
      if (scene.surface.kind != SurfaceKind::self_affine && turns)
        {
          // The box turns with the surface, unless that is drawn anew for the same box.
          const auto &size = scene.surface.size;
          const auto &grid = scene.contact.grid_points;
          set("Surface/Size", to_text(size[1]) + ", " + to_text(size[0]));
          set("Contact/Grid points",
              std::to_string(grid[1]) + ", " + std::to_string(grid[0]));
        }
      set("Realisations/Seeds", "");
      set("Realisations/Orientations", name_of(0));
      set("Realisations/Ranks each", "");
      set("Seal/Enabled", "false");
      set("Seal/Two in a row", yes_or_no(scene.has_two_boxes()));
      set("Output/Directory",
          scene.output.directory + "/realisation-" + std::to_string(realisation.number));
      Scene one      = make_scene(entries);
      one.oversights = scene.oversights; // Seal has an effect, on all together
      return one;
    }

    /** Whether there is a checkpoint; the same on all ranks of @p comm. Collective. */
    bool
    has_checkpoint(const Scene &scene, MPI_Comm comm)
    {
      std::error_code   none; // a path that cannot be accessed counts as none
      const std::string path = scene.output.directory + "/checkpoint";
      return maximum(comm, std::filesystem::exists(path, none) ? 1. : 0.) > 0;
    }

    /** Broadcast the results of @p realisation from rank @p root. Collective. */
    void
    share(RealisationRow &realisation, const int root)
    {
      const auto tell = [root](auto &value) {
        if constexpr (std::is_same_v<decltype(value), std::string &>)
          value = broadcast(MPI_COMM_WORLD, value, root);
        else
          MPI_Bcast(&value, sizeof value, MPI_BYTE, root, MPI_COMM_WORLD);
      };
      tell(realisation.converged);
      tell(realisation.threshold);
      for (std::string *text :
           {&realisation.status, &realisation.validity, &realisation.failure})
        tell(*text);
      tell(realisation.stopped);
    }

    /** Run @p scene, that of @p realisation alone, in this rank's group. */
    void
    run_alone(RealisationRow   &realisation,
              const Scene      &scene,
              const RankGroups &groups,
              const bool        is_quiet,
              const bool        resume)
    {
      // Only the first group writes to the screen.
      Log         log(groups.comm, is_quiet || groups.mine > 0);
      RunSummary &run = realisation;
      try
        {
          run = simulate(scene,
                         log,
                         resume && has_checkpoint(scene, groups.comm),
                         groups.comm);
          if (!run.converged)
            {
              std::string status = "not-converged";
              add_words(status, run.status);
              run.status = status;
            }
        }
      catch (const Interruption &stop)
        {
          realisation.stopped = true;
          realisation.failure = stop.what();
        }
      catch (const ComputationError &error)
        {
          // All ranks of the group catch the same error, and go on together.
          realisation.failure = error.what();
          run.status          = "failed";
          run.converged       = false;
        }
    }
  } // namespace

  bool
  run_all_realisations(const Scene &scene, Log &log, const bool resume)
  {
    if (!scene.realisations.enabled())
      return simulate(scene, log, resume).converged;

    const RankGroups            groups(scene.realisations.ranks_each);
    std::vector<RealisationRow> realisations = list_realisations(scene);
    require_memory(scene,
                   MPI_COMM_WORLD,
                   std::min(groups.number, static_cast<int>(realisations.size())));
    const std::string folder = scene.output.directory;
    RunState          state(scene, MPI_COMM_WORLD, resume);
    Log               silent(MPI_COMM_WORLD, true);
    for (const RealisationRow &next : realisations) // before anything is written
      {
        const Scene alone = scene_of(next, scene);
        if (!resume)
          check_input(alone, silent);
        else if (has_checkpoint(alone, MPI_COMM_WORLD))
          const RunState of_this_scene(alone, MPI_COMM_WORLD, true);
      }
    const auto lock = begin_results(scene, MPI_COMM_WORLD, log, resume);
    state.finished.reset();
    state.has_begun = true;
    state.save(); // marks the folder as one of these realisations
    Table<RealisationRow> table        = ensemble_table(scene);
    const auto            write_record = [&]() {
      write_record_of_ensemble(scene, n_ranks_in(MPI_COMM_WORLD), log);
    };
    run_on_root(MPI_COMM_WORLD, [&]() {
      write_record(); // for all who read the table while it grows
      table.open(folder, true);
    });

    bool        all_converged = true;
    std::size_t n_done        = 0;
    while (n_done < realisations.size())
      {
        // Run as many realisations at the same time as there are groups.
        const std::size_t  first = n_done;
        const std::size_t  end   = std::min(first + groups.number, realisations.size());
        std::vector<Scene> scenes;
        for (std::size_t k = first; k < end; ++k)
          {
            const RealisationRow &next = realisations[k];
            log.line(format("realisation %d of %zu: seed %llu, %s",
                            next.number,
                            realisations.size(),
                            next.seed,
                            name_of(next.orientation).c_str()));
            scenes.push_back(scene_of(next, scene));
          }
        const std::size_t mine = first + groups.mine;
        if (mine < end)
          run_alone(
            realisations[mine], scenes[groups.mine], groups, log.is_quiet(), resume);
        for (std::size_t k = first; k < end; ++k)
          {
            RealisationRow &done = realisations[k];
            share(done, static_cast<int>(k - first) * groups.n_each);
            if (done.stopped)
              throw Interruption(done.failure);
            if (!done.failure.empty())
              log.warn(done.failure);
            all_converged = all_converged && done.converged;
            ++n_done;
            run_on_root(MPI_COMM_WORLD, [&]() { table.append(done); });
          }
      }
    run_on_root(MPI_COMM_WORLD, [&]() {
      if (scene.programme.find_threshold)
        fit_results(folder, log);
      if (scene.seal.enabled)
        assess_whole_seal(scene, log);
      write_record(); // with all warnings
      draw_results(scene, log);
    });
    state.finished = RunSummary();
    state.save();
    return all_converged;
  }
} // namespace strait
