// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/signals.h>
#include <strait/base/text.h>
#include <strait/base/timers.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/flow/seal_mesh.h>
#include <strait/run/field_output.h>
#include <strait/run/guards.h>
#include <strait/run/load_sweep.h>
#include <strait/run/output_directory.h>
#include <strait/run/run_state.h>
#include <strait/run/simulation.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/read_scene.h>
#include <strait/surface/self_affine_surface.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <string>

namespace strait
{
  namespace
  {
    /** A mesh can only be as coarse as the grid can be halved. */
    void
    warn_of_odd_grid(const Scene &scene, Log &log)
    {
      // Cells with which each mesh then has to start: half of it is still solved in no
      // time, double of it is felt at every load.
      constexpr std::int64_t many       = 10000;
      const PeriodicGrid     grid       = grid_of(scene);
      const std::int64_t     n_coarsest = grid.n_points() >> (2 * grid.n_halvings());
      if (scene.fluid.enabled && n_coarsest > many)
        log.warn(
          "the coarsest mesh of this grid has " + std::to_string(n_coarsest) +
          " cells, which costs time and memory: choose numbers of grid points that "
          "can be halved several times");
    }

    /** The surface on the scene's grid, with all that is to be said about it. */
    SlabField
    make_heights(const Scene &scene, MPI_Comm comm, Log &log)
    {
      const PeriodicGrid grid = grid_of(scene);
      for (const std::string &warning : scene.warnings())
        log.warn(warning);
      for (const std::string &warning : implausible_numbers(scene))
        log.warn(warning);
      require_memory(scene, comm);
      for (const std::string &warning : check_resolution(scene.surface, grid))
        log.warn(warning);
      warn_of_odd_grid(scene, log);
      if (!scene.fluid.gas.empty())
        log.line(format("gas: %s, viscosity %.6g",
                        scene.fluid.gas.c_str(),
                        scene.fluid.viscosity));
      const int n_ranks = n_ranks_in(comm);
      log.line(format("grid %d × %d on a box of %.6g × %.6g, %d %s",
                      grid.nx,
                      grid.ny,
                      grid.lx,
                      grid.ly,
                      n_ranks,
                      n_ranks == 1 ? "rank" : "ranks"));
      if (!scene.contact.young_moduli.empty())
        log.line(format("contact modulus E* = %.6g", scene.contact.effective_modulus) +
                 (scene.units.pressure.empty() ? "" : " " + scene.units.pressure));
      log.stage("surface");
      Remarks   remarks;
      SlabField heights = make_surface(scene.surface, make_layout(grid, comm), &remarks);
      log.stage("");
      for (const std::string &note : remarks.notes)
        log.line(note);
      for (const std::string &warning : remarks.warnings)
        log.warn(warning);
      report_surface(scene, heights, log);
      return heights;
    }

    /** For a dry run; throws what the run would. */
    void
    describe_mesh(const Scene &scene, Log &log)
    {
      if (!scene.fluid.enabled || scene.fluid.mesh_file.empty())
        return;
      const PeriodicGrid grid = grid_of(scene);
      const SealMesh   seal = read_seal_mesh(scene.fluid.mesh_file, grid, MPI_COMM_WORLD);
      const FlowRegion region(grid,
                              seal.outline(.25 * std::min(grid.dx(), grid.dy())),
                              MPI_COMM_WORLD);
      log.line(format("mesh %s: %s of %zu cells around %lld grid points",
                      scene.fluid.mesh_file.c_str(),
                      seal.is_ring ? "a ring" : "a strip",
                      seal.cells.size(),
                      region.n_inside()));
    }

    /** For a dry run; throws if the grid does not resolve the range. */
    void
    describe_adhesion(const ContactParameters &contact,
                      const SlabField         &heights,
                      Log                     &log)
    {
      if (!contact.enabled || !contact.adhesion.enabled)
        return;
      if (contact.adhesion.matched_pressure > 0.)
        {
          log.line("adhesion on; its surface energy is found in the run");
          return;
        }
      const SceneAdhesion adhesion = adhesion_of_scene(contact, heights);
      log.line(format("adhesion on; range %.5g, E*/(k a) = %.3g (3 or more resolves it)",
                      adhesion.law.range,
                      adhesion.resolution));
    }

    /** What is simulated beside the surface. */
    std::vector<std::string>
    effects_of(const Scene &scene)
    {
      const ContactParameters &contact = scene.contact;
      const FluidParameters   &fluid   = scene.fluid;

      std::vector<std::string> names = {contact.enabled ? "contact"
                                                        : "the surface as the gap"};
      for (const auto &[is_on, name] :
           {std::pair{contact.enabled && contact.yields, "yielding"},
            {contact.enabled && contact.adhesion.enabled, "adhesion"},
            {contact.zoom.enabled, "windows of finer points"},
            {fluid.enabled, fluid.is_gas ? "gas" : "liquid"},
            {fluid.enabled && fluid.has_slip(), "slip"},
            {fluid.enabled && fluid.rarefaction != Rarefaction::none, "rarefaction"},
            {fluid.feedback.enabled, "fluid on the walls"},
            {fluid.feedback.keeps_trapped_fluid(), "trapped fluid"},
            {scene.theory.enabled, "theory"},
            {scene.output.error_budget, "error budget"},
            {scene.seal.enabled, "whole seal"}})
        if (is_on)
          names.emplace_back(name);
      return names;
    }

    /** The searches that come before the steps, unless they were made before. Throws
     *  Interruption if a signal asks for it. */
    void
    find_seals(const Scene     &scene,
               LoadSweep       &sweep,
               OutputDirectory &output,
               RunState        &state,
               MPI_Comm         comm,
               Log             &log)
    {
      if (state.has_searched)
        return;
      sweep.after_probe([&]() {
        state.save(sweep, output, log);
        if (stop_requested(comm))
          throw Interruption("");
      });
      if (scene.programme.find_threshold)
        output.write_table(threshold_table(scene), sweep.find_thresholds());
      if (scene.programme.find_blow_out)
        output.write_table(blow_out_table(scene), sweep.find_blow_outs());
      state.has_searched = true;
      sweep.end_searches();
      if (scene.programme.find_threshold || scene.programme.find_blow_out)
        state.save(sweep, output, log);
    }
  } // namespace

  RunSummary
  simulate(const Scene &scene, Log &log, const bool resume, MPI_Comm comm)
  {
    if (scene.is_theory_only()) // so quick that it begins anew
      return run_theory(scene, log, comm);
    Timers   timers;
    RunState state(scene, comm, resume);
    if (state.finished)
      {
        log.line("nothing is left to do in " + scene.output.directory);
        return *state.finished;
      }
    SlabField heights = [&]() {
      const auto scope = timers.scope("surface");
      return make_heights(scene, comm, log);
    }();
    const auto n_points = static_cast<double>(heights.grid().n_points());

    // The sweep takes the heights.
    const bool      is_shown = scene.output.surface_map || scene.output.surface_spectrum;
    const SlabField shown    = is_shown ? heights : SlabField();
    LoadSweep       sweep(scene, std::move(heights), log, timers, state.surface_energy);
    state.surface_energy = sweep.surface_energy();
    // The first thing that is written, after the last check of the input.
    OutputDirectory output(scene, comm, log, resume);
    if (resume)
      {
        state.restore(sweep, output, log);
        log.line(sweep.n_probes() > 0
                   ? format("resumed after %zu solves of a search", sweep.n_probes())
                   : format("resumed after step %d", sweep.n_done()));
      }
    else
      {
        write_surface(scene, shown);
        state.save(sweep, output, log);
      }
    bool stopped = false, converged = true;
    try
      {
        find_seals(scene, sweep, output, state, comm, log);
      }
    catch (const Interruption &)
      {
        stopped = true;
      }
    const auto write_jumps = [&]() {
      if (!sweep.jumps().empty())
        output.write_table(jump_table(scene), sweep.jumps());
    };
    const int  n_steps          = sweep.n_steps();
    const auto is_asked_to_stop = [&]() {
      return sweep.n_done() < n_steps && stop_requested(comm);
    };
    stopped = stopped || is_asked_to_stop();
    if (!stopped)
      converged = sweep.run([&](const Step &step) {
        {
          const auto scope = timers.scope("output");
          output.write(step, step.number == n_steps);
          write_jumps();
        }
        {
          const auto scope = timers.scope("checkpoint");
          state.save(sweep, output, log);
        }
        stopped = is_asked_to_stop();
        return !stopped;
      });
    if (!stopped && sweep.state().contact)
      write_indented_surface(scene, shown, *sweep.state().contact);
    write_jumps();
    RunSummary summary =
      output.finish(sweep.known_thresholds(), timers, most_memory(comm) / n_points);
    summary.stopped   = stopped;
    summary.converged = converged;
    if (!stopped)
      state.save_mark(summary);
    return summary;
  }

  void
  describe(const Scene &scene, Log &log)
  {
    if (scene.is_theory_only())
      {
        describe_theory(scene, log);
        return;
      }
    const SlabField heights = make_heights(scene, MPI_COMM_WORLD, log);
    describe_adhesion(scene.contact, heights, log);
    describe_mesh(scene, log);
    // Realisations that would run beside each other have a grid each.
    const std::vector<int> &each    = scene.realisations.ranks_each;
    const int               n_ranks = n_ranks_in(MPI_COMM_WORLD);
    const int n_grids = each.empty() ? 1 : std::max(1, n_ranks / each.front());
    log.line(format(
      "memory for the grid, without the mesh: about %.3g of %.3g GB that are free; %zu steps",
      1e-9 * n_grids * memory_of_grid(scene),
      1e-9 * free_memory(),
      plan_stops(scene, {}).size()));
    log.line("on are: " + join(effects_of(scene), ", "));
    if (scene.programme.find_threshold)
      log.line("the threshold is searched to a relative width of " +
               to_text(scene.programme.threshold_tolerance) + "; " +
               std::to_string(scene.programme.reduced_loads.size() *
                              scene.fluid.slip_lengths.size()) +
               " steps near it");
    for (const std::string &line : predict_cost(scene, statistics(heights).rms_slope))
      log.line(line);
    if (scene.realisations.enabled())
      log.line(
        std::to_string(std::max<std::size_t>(scene.realisations.seeds.size(), 1) *
                       scene.realisations.orientations.size()) +
        " realisations, " +
        (n_grids == 1 ? "one after the other" : std::to_string(n_grids) + " at a time"));
  }
} // namespace strait
