// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/signals.h>
#include <strait/base/text.h>
#include <strait/base/timers.h>
#include <strait/flow/seal_mesh.h>
#include <strait/run/field_output.h>
#include <strait/run/guards.h>
#include <strait/run/load_sweep.h>
#include <strait/run/output_directory.h>
#include <strait/run/run_state.h>
#include <strait/run/simulation.h>
#include <strait/run/theory_prediction.h>
#include <strait/seal/make_seal.h>
#include <strait/surface/read_scene.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace strait
{
  namespace
  {
    /** Read the seal mesh, if there is one. Throws what the run would. */
    void
    check_mesh(const Scene &scene, Log &log)
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

    /** Make the heights of a scene and check all its input. Throws what the run would
     *  before it computes anything else. */
    SlabField
    checked_heights(const Scene &scene, Log &log)
    {
      SlabField                 heights  = make_heights(scene, MPI_COMM_WORLD, log);
      const AdhesionParameters &adhesion = scene.contact.adhesion;
      if (scene.contact.enabled && adhesion.enabled && adhesion.matched_pressure > 0.)
        log.line("adhesion: its surface energy is found in the run");
      else
        complete_contact(scene, heights, 0., log);
      check_mesh(scene, log);
      return heights;
    }

    /** Names of the effects that the scene enables. */
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

    /** Run the searches that come before the steps, unless they are over. */
    void
    find_seals(const Scene                 &scene,
               LoadSweep                   &sweep,
               const OutputDirectory       &output,
               const std::function<void()> &save)
    {
      if (sweep.search() == nullptr)
        return;
      sweep.search()->after_probe = save;
      if (scene.programme.find_threshold)
        output.write_table(threshold_table(scene), sweep.find_thresholds());
      if (scene.programme.find_blow_out)
        output.write_table(blow_out_table(scene), sweep.find_blow_outs());
      sweep.end_searches();
      save();
    }

    TheoryPrediction
    make_theory(const Scene &scene, Log &log, MPI_Comm comm)
    {
      if (scene.theory.spectrum_of_surface)
        {
          const SlabField heights = make_heights(scene, comm, log);
          return {scene, &heights};
        }
      for (const std::string &warning : scene.warnings())
        log.warn(warning);
      check_numbers(scene, log);
      return {scene, nullptr};
    }

    void
    report_spectrum(const RadialSpectrum &spectrum, Log &log)
    {
      log.line(
        format("theory of the spectrum from q = %.5g to %.5g: rms height %.5g, rms "
               "slope %.5g",
               spectrum.sections.front().from,
               spectrum.sections.back().to,
               std::sqrt(spectrum.height_square()),
               std::sqrt(spectrum.slope_square())));
    }

    /** Evaluate the theory alone at every load and slip length and write the results.
     *  Heights on a grid are made only if the scene asks for their spectrum. */
    RunSummary
    run_theory(const Scene &scene, Log &log, MPI_Comm comm)
    {
      Timers                 timers;
      const TheoryPrediction theory = make_theory(scene, log, comm);
      report_spectrum(theory.spectrum(), log);
      OutputDirectory output(scene, comm, log);
      const auto      n_steps = static_cast<int>(scene.programme.pressures.size() *
                                            scene.fluid.slip_lengths.size());
      Step            step;
      for (const double pressure : scene.programme.pressures)
        for (const double slip_length : scene.fluid.slip_lengths)
          {
            ++step.number;
            step.state.control.slip_length = slip_length;
            {
              const auto scope = timers.scope("theory");
              step.theory      = theory.predict(pressure, slip_length, nullptr, nullptr);
            }
            judge_validity(step, scene, std::sqrt(theory.spectrum().slope_square()), log);
            report_step(step, n_steps, log);
            const auto scope = timers.scope("output");
            output.write(step, step.number == n_steps);
          }
      return output.finish({}, timers, 0.);
    }

    void
    describe_theory(const Scene &scene, Log &log)
    {
      report_spectrum(make_theory(scene, log, MPI_COMM_WORLD).spectrum(), log);
      log.line(
        format("theory alone, %s; contact off, fluid off; %zu steps",
               scene.theory.spectrum_of_surface ? "for the heights on the grid"
                                                : "without a grid",
               scene.programme.pressures.size() * scene.fluid.slip_lengths.size()));
    }
  } // namespace

  RunSummary
  simulate(const Scene &scene, Log &log, const bool resume, MPI_Comm comm)
  {
    if (scene.is_theory_only()) // so quick that there is no need to resume
      return run_theory(scene, log, comm);
    Timers   timers;
    RunState state(scene, comm, resume);
    if (state.finished)
      {
        log.line("nothing is left to do in " + scene.output.directory);
        return *state.finished;
      }
    auto       timing   = timers.scope("surface");
    SlabField  heights  = make_heights(scene, comm, log);
    const auto n_points = static_cast<double>(heights.grid().n_points());
    timing.reset();

    // Keep a copy, as the sweep takes the heights.
    const bool      is_shown = scene.output.surface_map || scene.output.surface_spectrum;
    const SlabField shown    = is_shown ? heights : SlabField();
    LoadSweep       sweep(scene, std::move(heights), log, timers, state.surface_energy);
    state.surface_energy = sweep.progress().surface_energy;
    // This writes the first files, after the last check of the input.
    OutputDirectory output(scene, comm, log, resume);
    const auto      parts = [&](StateArchive &archive) {
      output.transfer(archive);
      sweep.transfer(archive);
      std::vector<std::string> warnings = log.warnings();
      archive.value(warnings);
      if (archive.is_reading())
        log.keep_warnings(warnings);
    };
    if (resume)
      {
        state.restore(parts);
        log.line(
          sweep.search() != nullptr
            ? format("resumed after %zu solves of a search", sweep.search()->n_probes())
            : format("resumed after step %d", sweep.progress().n_done));
      }
    else
      state.save(parts);
    write_surface(scene, shown);
    const auto stop_if_asked = [&]() {
      const bool is_done =
        sweep.search() == nullptr && sweep.progress().n_done == sweep.n_steps();
      if (!is_done && stop_requested(comm))
        throw Interruption("");
    };
    const auto save = [&]() {
      {
        const auto scope = timers.scope("checkpoint");
        state.save(parts);
      }
      stop_if_asked();
    };
    const auto write_jumps = [&]() {
      if (!sweep.progress().jumps.empty())
        output.write_table(jump_table(scene), sweep.progress().jumps);
    };
    bool stopped = false, lacks_last = false;
    try
      {
        find_seals(scene, sweep, output, save);
        stop_if_asked();
        sweep.run([&](const Step &step) {
          {
            const auto scope   = timers.scope("output");
            const bool is_last = step.number == sweep.n_steps();
            output.write(step, is_last);
            write_jumps();
            lacks_last = !is_last || (step.state.fluid && step.state.fluid->lifted_off);
            if (is_last && step.state.contact)
              write_indented_surface(scene, shown, *step.state.contact);
          }
          save();
        });
      }
    catch (const Interruption &)
      {
        stopped = true;
      }
    write_jumps();
    if (!stopped && lacks_last && scene.output.fields == FieldOutput::last)
      log.warn(
        "Output/Fields = last wrote none, as the walls part before the last load; "
        "set it to all, or leave out the loads behind");
    RunSummary summary =
      output.finish(sweep.progress().thresholds, timers, peak_memory(comm) / n_points);
    if (stopped)
      throw Interruption(
        "Stopped by " + name_of_stop_signal() +
        " after a complete step or solve of a search; " +
        (scene.output.checkpoint
           ? "the same command with --resume continues."
           : "with Output/Checkpoint = true it could have been resumed."));
    summary.converged = sweep.progress().converged;
    state.finished    = summary;
    state.save();
    return summary;
  }

  void
  check_input(const Scene &scene, Log &log)
  {
    if (scene.is_theory_only())
      make_theory(scene, log, MPI_COMM_WORLD);
    else
      checked_heights(scene, log);
  }

  void
  describe(const Scene &scene, Log &log)
  {
    if (scene.is_theory_only())
      {
        describe_theory(scene, log);
        return;
      }
    const SlabField heights = checked_heights(scene, log);
    // Realisations that run at the same time have a grid each.
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
    if (scene.contact.enabled && scene.fluid.enabled)
      log.line(limiting_error(scene, statistics(heights).rms_slope));
    if (scene.realisations.enabled())
      log.line(
        std::to_string(std::max<std::size_t>(scene.realisations.seeds.size(), 1) *
                       scene.realisations.orientations.size()) +
        " realisations, " +
        (n_grids == 1 ? "one after the other" : std::to_string(n_grids) + " at a time"));
  }
} // namespace strait
