// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/load_sweep.h>
#include <strait/driver/step_report.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <chrono>

namespace strait
{
  namespace
  {
    double
    seconds_since(const Timers::Clock::time_point start)
    {
      return std::chrono::duration<double>(Timers::Clock::now() - start).count();
    }
  } // namespace

  LoadSweep::LoadSweep(const Scene &scene_, SlabField heights, Log &log_, Timers &timers_)
    : scene(scene_)
    , log(log_)
    , timers(timers_)
    , first_guess(0.)
  {
    if (scene.fluid.enabled)
      flow = std::make_unique<FlowStage>(scene, heights.layout_pointer(), log, timers);
    if (scene.theory.enabled)
      theory = std::make_unique<TheoryPrediction>(scene, &heights);
    if (!scene.contact.enabled)
      {
        given_gap = std::move(heights);
        return;
      }
    ContactParameters parameters = scene.contact;
    if (scene.programme.find_threshold)
      {
        // Rough surfaces seal at 0.24 ± 0.03 E* times their rms slope, the square
        // saddle at 0.229: start a little to the side that the scene names.
        const double share = scene.programme.path == LoadPath::loading ? .2 : .28;
        first_guess =
          share * parameters.effective_modulus * statistics(heights).rms_slope;
        // The verdict must not depend on what the solver leaves over.
        parameters.tolerance =
          std::min(parameters.tolerance, .01 * scene.programme.threshold_tolerance);
      }
    contact = std::make_unique<ContactSolver>(parameters, std::move(heights));
    if (scene.fluid.feedback.enabled)
      coupling = std::make_unique<CoupledStage>(scene, *contact, *flow, log);
  }

  const std::vector<Threshold> &
  LoadSweep::find_thresholds()
  {
    const auto scope = timers.scope("threshold");
    // A dry contact, once probed, serves all slip lengths.
    double     slip_length = 0.;
    const auto probe_load  = [&](const double load) { return probe(load, slip_length); };
    ThresholdSearch search(probe_load, first_guess, scene.programme.threshold_tolerance);
    for (const double next : scene.fluid.slip_lengths)
      {
        slip_length = next;
        if (coupling)
          search =
            ThresholdSearch(probe_load, first_guess, scene.programme.threshold_tolerance);
        thresholds.push_back(search.find(slip_length));
        const Threshold &found = thresholds.back();
        log.line(
          format("threshold%s: critical load between %.10g and %.10g, contact "
                 "%.3f %% (%d contact solves, %ld FFT pairs)",
                 scene.fluid.has_slip()
                   ? format(" for slip length %.4g", slip_length).c_str()
                   : "",
                 found.lower,
                 found.upper,
                 100. * found.contact_area,
                 found.n_solves,
                 found.fft_pairs));
      }
    return thresholds;
  }

  std::vector<BlowOut>
  LoadSweep::find_blow_outs()
  {
    const auto           scope  = timers.scope("blow-out");
    const double         outlet = scene.fluid.outlet_pressure;
    std::vector<BlowOut> result;
    for (const double load : scene.programme.pressures)
      {
        // The pressure rises: each probe starts from the fluid of the last held one.
        SlabField held(contact->layout());
        result.push_back(find_blow_out(
          [&](const double pressure) {
            flow->set_inlet_pressure(outlet + pressure);
            coupling->fluid_pressure() = held;
            Step step;
            step.slip_length = scene.fluid.slip_lengths.front();
            coupling->settle(step, load);
            BlowOutProbe probe;
            probe.leaks        = step.flow->clusters.percolates;
            probe.contact_area = step.contact->contact_area;
            if (!probe.leaks)
              held = coupling->fluid_pressure();
            else if (!step.flow->paths.empty())
              probe.constriction = step.flow->paths.front().bottleneck;
            log.progress(format("  blow-out: inlet pressure %.6g %s",
                                outlet + pressure,
                                probe.leaks ? "leaks" : "is held"));
            return probe;
          },
          load,
          scene.programme.threshold_tolerance));
        BlowOut &found = result.back();
        found.load     = load;
        found.lower += outlet;
        found.upper += outlet;
        log.line(
          format("blow-out at a load of %.6g: inlet pressure between %.8g and "
                 "%.8g (%d solves of contact and flow)",
                 load,
                 found.lower,
                 found.upper,
                 found.n_solves));
      }
    flow->set_inlet_pressure(scene.fluid.inlet_pressure);
    coupling->fluid_pressure() = SlabField(contact->layout());
    return result;
  }

  ContactState
  LoadSweep::state_under(const double load, const double slip_length)
  {
    if (!coupling)
      return contact->solve(load);
    // Each probe starts from the fluid on the side that the path comes from.
    if (!probe_start.empty())
      coupling->fluid_pressure() = probe_start;
    Step step;
    step.slip_length = slip_length;
    coupling->settle(step, load);
    const bool open = step.flow->clusters.percolates;
    if (open == (scene.programme.path == LoadPath::loading))
      probe_start = coupling->fluid_pressure();
    if (!step.feedback->converged && !step.feedback->undecided)
      log.warn(format("contact and flow did not agree at a load of %.6g", load));
    return std::move(*step.contact);
  }

  ThresholdProbe
  LoadSweep::probe(const double load, const double slip_length)
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
    const ThresholdProbe result{find_bottleneck(openness, scene.fluid.direction),
                                state.contact_area,
                                state.fft_pairs};
    log.progress(format("  threshold: load %.8g %s",
                        load,
                        result.bottleneck.value > 0 ? "leaks" : "seals"));
    return result;
  }

  const Threshold *
  LoadSweep::threshold_of(const double slip_length) const
  {
    for (const Threshold &threshold : thresholds)
      if (threshold.slip_length == slip_length)
        return &threshold;
    return nullptr;
  }

  std::vector<LoadSweep::Stop>
  LoadSweep::plan() const
  {
    const std::vector<double> slips =
      scene.fluid.enabled ? scene.fluid.slip_lengths : std::vector<double>{0.};
    std::vector<Stop> stops;
    for (const double target :
         scene.contact.enabled ? scene.programme.pressures : std::vector<double>{0.})
      for (const double slip_length : slips)
        stops.push_back({target, slip_length});

    std::vector<Stop> near_threshold;
    for (const Threshold &threshold : thresholds)
      for (const double reduced : scene.programme.reduced_loads)
        near_threshold.push_back(
          {(1 - reduced) * threshold.critical_load(), threshold.slip_length});
    const bool upwards = scene.programme.path == LoadPath::loading;
    std::stable_sort(near_threshold.begin(),
                     near_threshold.end(),
                     [upwards](const Stop &a, const Stop &b) {
                       return upwards ? a.target < b.target : a.target > b.target;
                     });
    stops.insert(stops.end(), near_threshold.begin(), near_threshold.end());
    return stops;
  }

  bool
  LoadSweep::run(const Consumer &consume)
  {
    const std::vector<Stop> stops     = plan();
    bool                    converged = true;
    Step                    step;
    for (std::size_t k = 0; k < stops.size(); ++k)
      {
        step.number      = static_cast<int>(k) + 1;
        step.slip_length = stops[k].slip_length;
        if (coupling)
          press_with_fluid(step, stops[k].target);
        else
          {
            if (k > 0 && stops[k].target == stops[k - 1].target)
              step.contact_seconds = 0.; // another slip length in the same gap
            else
              press(step, stops[k].target);
            leak(step);
          }
        compare_with_threshold(step);
        compare_with_theory(step);
        converged = converged && step.converged();
        report_step(step, static_cast<int>(stops.size()), timers.total(), log);
        consume(step);
      }
    return converged;
  }

  void
  LoadSweep::press(Step &step, const double target)
  {
    if (!contact)
      {
        step.gap      = given_gap;
        SlabField gap = given_gap;
        for (double &value : gap)
          value = std::max(value, 0.);
        step.mean_gap = mean(gap);
        return;
      }
    const auto scope     = timers.scope("contact");
    const auto start     = Timers::Clock::now();
    step.contact         = contact->solve(target);
    step.gap             = step.contact->gap;
    step.mean_gap        = step.contact->mean_gap;
    step.contact_seconds = seconds_since(start);
  }

  void
  LoadSweep::leak(Step &step)
  {
    if (!flow)
      return;
    const auto scope  = timers.scope("flow");
    const auto start  = Timers::Clock::now();
    step.flow         = flow->solve(step.gap, step.slip_length);
    step.flow_seconds = seconds_since(start);
  }

  void
  LoadSweep::press_with_fluid(Step &step, const double target)
  {
    const auto scope = timers.scope("coupling");
    const auto start = Timers::Clock::now();
    step.flow.reset(); // its mesh was made for another gap
    coupling->solve(step, target);
    step.flow_seconds = seconds_since(start) - step.contact_seconds;
  }

  void
  LoadSweep::compare_with_threshold(Step &step) const
  {
    step.doubts.clear();
    const Threshold *threshold = threshold_of(step.slip_length);
    if (threshold == nullptr)
      return;
    constexpr double points_needed = 7., load_errors_needed = 20.;
    const double     reduced =
      1. - step.contact->nominal_pressure / threshold->critical_load();
    step.reduced_load = reduced;
    if (!(reduced > 0) || !step.flow->constrictions)
      return;
    const double uncertainty = .5 * threshold->relative_width();
    const double points      = step.flow->constrictions->points_along;
    if (reduced < load_errors_needed * uncertainty)
      {
        step.doubts.emplace_back("uncertain-threshold");
        log.warn(
          format("at a reduced load of %.3g the critical load, known to %.1e, is too "
                 "uncertain: a threshold tolerance of %.1e would do",
                 reduced,
                 uncertainty,
                 2. * reduced / load_errors_needed));
      }
    if (!(points >= points_needed))
      {
        step.doubts.emplace_back("unresolved-throat");
        log.warn(
          format("at a reduced load of %.3g the throat has %.2g grid points along it, "
                 "%.0f are needed: a grid finer by a factor of %.2g would do",
                 reduced,
                 points,
                 points_needed,
                 points_needed / points));
      }
  }

  void
  LoadSweep::compare_with_theory(Step &step)
  {
    if (!theory)
      return;
    const auto scope = timers.scope("theory");
    step.theory      = theory->predict(step.contact ? step.contact->nominal_pressure : 0.,
                                  step.slip_length,
                                  &step.gap,
                                  threshold_of(step.slip_length));
  }

  std::size_t
  LoadSweep::memory_consumption() const
  {
    return (contact ? contact->memory_consumption() : given_gap.size() * sizeof(double)) +
           (flow ? flow->memory_consumption() : 0) +
           (coupling ? coupling->memory_consumption() : 0);
  }
} // namespace strait
