// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/seal_search.h>

#include <algorithm>

namespace strait
{
  SealSearch::SealSearch(const Scene &scene_, const Stages &stages_, Log &log_)
    : scene(scene_)
    , stages(stages_)
    , log(log_)
  {
  }

  std::vector<Threshold>
  SealSearch::find_thresholds(const double first_guess)
  {
    std::vector<Threshold> result;
    // A dry contact, once probed, serves all slip lengths.
    double       slip_length = 0.;
    const auto   ask = [&](const double load) { return probe_load(load, slip_length); };
    const double tolerance = scene.programme.threshold_tolerance;
    ThresholdSearch dry_search(ask, first_guess, tolerance);
    for (const double next : scene.fluid.slip_lengths)
      {
        slip_length = next;
        if (stages.coupling == nullptr)
          result.push_back(dry_search.find(slip_length));
        else
          result.push_back(ThresholdSearch(ask, first_guess, tolerance)
                             .find_slowly(slip_length, is_loading()));
        report(result.back());
      }
    return result;
  }

  void
  SealSearch::report(const Threshold &found) const
  {
    log.line(
      format("threshold%s: critical load between %.10g and %.10g, contact "
             "%.3f %% (%d contact solves, %ld FFT pairs)",
             scene.fluid.has_slip()
               ? format(" for slip length %.4g", found.slip_length).c_str()
               : "",
             found.lower,
             found.upper,
             100. * found.contact_area,
             found.n_solves,
             found.fft_pairs));
  }

  ThresholdProbe
  SealSearch::probe_load(const double load, const double slip_length)
  {
    if (loads.is_known())
      return loads.recall();
    const ThresholdProbe answer = probe(load, slip_length);
    loads.note(answer);
    look_up();
    return answer;
  }

  ThresholdProbe
  SealSearch::probe(const double load, const double slip_length)
  {
    const ContactState  state = state_under(load, slip_length);
    const PeriodicGrid &grid  = state.gap.grid();
    if (!state.converged)
      log.warn(format("the contact did not converge at a load of %.6g, residual %.1e",
                      load,
                      state.residual));
    // Under pressure a point is closed the more firmly the more its own spacing is
    // indented: a length, like the gap, and of one slope with it.
    const double softness =
      std::max(grid.dx(), grid.dy()) / scene.contact.effective_modulus;
    SlabField openness = state.gap;
    for (std::size_t k = 0; k < openness.size(); ++k)
      if (state.pressure[k] > 0)
        openness[k] = -softness * state.pressure[k];
    const ThresholdProbe result{find_bottleneck(openness, stages.flow->domain()),
                                state.contact_area,
                                state.fft_pairs};
    log.progress(format("  threshold: load %.8g %s",
                        load,
                        result.bottleneck.value > 0 ? "leaks" : "seals"));
    return result;
  }

  ContactState
  SealSearch::state_under(const double load, const double slip_length)
  {
    if (stages.coupling != nullptr)
      return state_with_fluid(load, slip_length);
    if (stages.adhesive != nullptr)
      return stages.adhesive->state_for_search(load, stages.flow->domain());
    return stages.contact->solve(load);
  }

  ContactState
  SealSearch::state_with_fluid(const double load, const double slip_length)
  {
    // Each probe starts from the fluid on the side that the path comes from.
    const SlabField &start = is_loading() ? open_fluid : held_fluid;
    if (!start.empty())
      stages.coupling->fluid_pressure() = start;
    Step step;
    step.slip_length = slip_length;
    stages.coupling->settle(step, load);
    keep_fluid(step.flow->channel.percolates());
    warn_of_disagreement(step, load);
    return std::move(*step.contact);
  }

  bool
  SealSearch::is_loading() const
  {
    return scene.programme.path != LoadPath::unloading;
  }

  void
  SealSearch::warn_of_disagreement(const Step &step, const double load) const
  {
    const StepFeedback &feedback = *step.feedback;
    if (!feedback.converged && !feedback.undecided && !feedback.lifted_off)
      log.warn(
        format("contact and flow did not agree at a load of %.6g and an inlet "
               "pressure of %.6g",
               load,
               stages.flow->fluid().inlet_pressure));
  }

  std::vector<BlowOut>
  SealSearch::find_blow_outs()
  {
    const double         outlet = scene.fluid.outlet_pressure;
    std::vector<BlowOut> result;
    for (const double load : scene.programme.pressures)
      {
        BlowOut found = blow_out(load);
        if (scene.programme.find_resealing)
          found.resealing = resealing(found);
        found.lower += outlet;
        found.upper += outlet;
        log.line(
          format("blow-out at a load of %.6g: inlet pressure between %.8g and "
                 "%.8g (%d solves of contact and flow)",
                 load,
                 found.lower,
                 found.upper,
                 found.n_solves));
        if (found.resealing)
          {
            found.resealing->lower += outlet;
            found.resealing->upper += outlet;
            log.line(format("it closes again between %.8g and %.8g",
                            found.resealing->lower,
                            found.resealing->upper));
          }
        result.push_back(found);
      }
    stages.flow->set_inlet_pressure(scene.fluid.inlet_pressure);
    stages.coupling->fluid_pressure() = SlabField(stages.contact->layout());
    return result;
  }

  BlowOut
  SealSearch::blow_out(const double load)
  {
    // The pressure rises: each probe starts from the fluid of the last held one.
    if (!pressures.is_known())
      held_fluid = SlabField(stages.contact->layout());
    BlowOut found = find_blow_out(
      [&](const double pressure) { return probe_pressure(load, pressure, held_fluid); },
      load,
      scene.programme.threshold_tolerance);
    found.load = load;
    return found;
  }

  Resealing
  SealSearch::resealing(BlowOut &found)
  {
    if (found.upper == 0)
      return {}; // it leaks without any pressure
    // The pressure falls: from the fluid of the last one that leaked.
    return find_resealing(
      [&](const double pressure) {
        return probe_pressure(found.load, pressure, open_fluid);
      },
      found.upper,
      scene.programme.threshold_tolerance,
      found.n_solves);
  }

  BlowOutProbe
  SealSearch::probe_pressure(const double     load,
                             const double     pressure_difference,
                             const SlabField &start)
  {
    if (pressures.is_known())
      return pressures.recall();
    const BlowOutProbe answer = pressurise(load, pressure_difference, start);
    keep_fluid(answer.leaks);
    pressures.note(answer);
    look_up();
    return answer;
  }

  void
  SealSearch::transfer(StateArchive &archive)
  {
    loads.transfer(archive);
    pressures.transfer(archive);
    if (stages.coupling != nullptr)
      for (SlabField *fluid : {&open_fluid, &held_fluid})
        archive.field(*fluid, stages.contact->layout());
  }

  void
  SealSearch::keep_fluid(const bool leaks)
  {
    (leaks ? open_fluid : held_fluid) = stages.coupling->fluid_pressure();
  }

  BlowOutProbe
  SealSearch::pressurise(const double     load,
                         const double     pressure_difference,
                         const SlabField &start)
  {
    const double inlet = scene.fluid.outlet_pressure + pressure_difference;
    stages.flow->set_inlet_pressure(inlet);
    stages.coupling->fluid_pressure() = start;
    Step step;
    step.slip_length = scene.fluid.slip_lengths.front();
    stages.coupling->settle(step, load);
    warn_of_disagreement(step, load);
    BlowOutProbe result;
    result.leaks        = step.flow->channel.percolates();
    result.contact_area = step.contact->contact_area;
    if (result.leaks && !step.flow->channel.paths.empty())
      result.constriction = step.flow->channel.paths.front().bottleneck;
    log.progress(format("  blow-out: inlet pressure %.6g %s",
                        inlet,
                        result.leaks ? "leaks" : "is held"));
    return result;
  }
} // namespace strait
