// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/load_sweep.h>
#include <strait/driver/step_report.h>
#include <strait/driver/threshold_doubts.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <utility>

namespace strait
{
  LoadSweep::LoadSweep(const Scene &scene_,
                       SlabField    heights,
                       Log         &log_,
                       Timers      &timers_,
                       const double surface_energy)
    : scene(scene_)
    , log(log_)
    , timers(timers_)
    , layout(heights.layout_pointer())
    , first_guess(0.)
  {
    if (scene.fluid.enabled)
      {
        flow =
          std::make_unique<FlowStage>(scene.fluid, heights.layout_pointer(), log, timers);
        if (scene.programme.find_threshold)
          flow->watch_constrictions();
        error_budget = std::make_unique<ErrorBudget>(scene, heights);
      }
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
        const double share = scene.programme.path == LoadPath::unloading ? .28 : .2;
        first_guess =
          share * parameters.effective_modulus * statistics(heights).rms_slope;
        // The verdict must not depend on what the solver leaves over.
        parameters.tolerance =
          std::min(parameters.tolerance, .01 * scene.programme.threshold_tolerance);
      }
    if (surface_energy > 0.)
      {
        parameters.adhesion.surface_energy   = surface_energy;
        parameters.adhesion.matched_pressure = 0.;
      }
    if (scene.contact.adhesion.enabled)
      adhesive =
        std::make_unique<AdhesiveSweep>(scene, parameters, std::move(heights), log);
    else
      contact = std::make_unique<ContactSolver>(parameters, std::move(heights));
    if (scene.fluid.feedback.enabled)
      coupling = std::make_unique<CoupledStage>(scene, *contact, *flow, log);
    if (scene.programme.find_threshold || scene.programme.find_blow_out)
      search = std::make_unique<SealSearch>(
        scene,
        SealSearch::Stages{contact.get(), adhesive.get(), flow.get(), coupling.get()},
        log);
  }

  void
  LoadSweep::after_probe(SealSearch::AfterProbe action)
  {
    if (search)
      search->after_probe(std::move(action));
  }

  std::size_t
  LoadSweep::n_probes() const
  {
    return search ? search->n_probes() : 0;
  }

  void
  LoadSweep::end_searches()
  {
    search.reset();
    if (adhesive)
      adhesive->end_search();
  }

  const std::vector<Threshold> &
  LoadSweep::find_thresholds()
  {
    const auto scope = timers.scope("threshold");
    thresholds       = search->find_thresholds(first_guess);
    return thresholds;
  }

  std::vector<BlowOut>
  LoadSweep::find_blow_outs()
  {
    const auto scope = timers.scope("blow-out");
    return search->find_blow_outs();
  }

  const Threshold *
  LoadSweep::threshold_of(const double slip_length) const
  {
    for (const Threshold &threshold : thresholds)
      if (threshold.slip_length == slip_length)
        return &threshold;
    return nullptr;
  }

  bool
  LoadSweep::run(const Consumer &consume)
  {
    const std::vector<LoadStop> stops = plan_stops(scene, thresholds);
    while (next_stop < stops.size())
      {
        const std::size_t k = next_stop;
        step.number         = static_cast<int>(k) + 1;
        step.branch         = branch_of(scene, stops, k);
        step.slip_length    = stops[k].slip_length;
        if (coupling)
          press_with_fluid(step, stops[k].target);
        else
          {
            if (is_pressed(stops))
              step.contact_seconds = step.dissipated_energy = 0.; // another slip length
            else if (!press(step, stops[k]))
              {
                log.warn(
                  format("the surfaces part under tension before the pressure %.6g: "
                         "%zu steps are left out",
                         stops[k].target,
                         stops.size() - k));
                break;
              }
            leak(step);
          }
        compare_with_threshold(step);
        compare_with_theory(step);
        step.errors =
          step.flow && step.flow->solution ? error_budget->assess(step) : StepErrors();
        converged = converged && step.converged();
        report_step(step, static_cast<int>(stops.size()), timers.total(), log);
        ++next_stop;
        if (!consume(step))
          break;
      }
    return converged;
  }

  /** Whether the next step differs from the last in the slip length only. */
  bool
  LoadSweep::is_pressed(const std::vector<LoadStop> &stops) const
  {
    return next_stop > 0 && next_stop < stops.size() && !step.gap.empty() &&
           stops[next_stop].target == stops[next_stop - 1].target;
  }

  void
  LoadSweep::transfer(StateArchive &archive)
  {
    transfer_thresholds(archive, thresholds);
    auto n_steps_done = static_cast<long>(next_stop);
    archive.value(n_steps_done);
    next_stop = n_steps_done;
    archive.value(converged);
    if (contact)
      contact->transfer(archive);
    if (adhesive)
      adhesive->transfer(archive);
    if (coupling)
      coupling->transfer(archive);
    if (error_budget)
      error_budget->transfer(archive);
    transfer_search(archive);
    bool goes_on = step.contact && !coupling && is_pressed(plan_stops(scene, thresholds));
    archive.value(goes_on);
    if (!goes_on)
      return;
    if (archive.is_reading())
      step.contact.emplace();
    strait::transfer(archive, *step.contact, layout);
    step.gap      = step.contact->gap;
    step.mean_gap = step.contact->mean_gap;
  }

  /** A search that is done leaves nothing. */
  void
  LoadSweep::transfer_search(StateArchive &archive)
  {
    bool searches = search != nullptr;
    archive.value(searches);
    if (!searches)
      end_searches();
    if (search)
      search->transfer(archive);
  }

  /** Set what the step has of contact. Return whether there is any. */
  bool
  LoadSweep::press(Step &step, const LoadStop &stop)
  {
    if (!scene.contact.enabled)
      {
        step.gap      = given_gap;
        SlabField gap = given_gap;
        for (double &value : gap)
          value = std::max(value, 0.);
        step.mean_gap = mean(gap);
        return true;
      }
    const auto scope = timers.scope("contact");
    const auto start = Timers::Clock::now();
    if (!adhesive)
      step.contact = contact->solve(stop.target);
    else
      {
        BranchFollower &path = adhesive->path();
        if (step.number == 1 || stop.begins_anew)
          path.begin_anew();
        BranchFollower::Arrival arrival = path.go_to(stop.target);
        if (!arrival.state)
          return false;
        step.contact           = std::move(arrival.state);
        step.dissipated_energy = arrival.dissipated;
      }
    step.gap             = step.contact->gap;
    step.mean_gap        = step.contact->mean_gap;
    step.contact_seconds = Timers::seconds_since(start);
    return true;
  }

  void
  LoadSweep::leak(Step &step)
  {
    if (!flow)
      return;
    const auto scope  = timers.scope("flow");
    const auto start  = Timers::Clock::now();
    step.flow         = flow->solve(step.gap, step.slip_length);
    step.flow_seconds = Timers::seconds_since(start);
  }

  void
  LoadSweep::press_with_fluid(Step &step, const double target)
  {
    const auto scope = timers.scope("coupling");
    const auto start = Timers::Clock::now();
    step.flow.reset(); // its mesh was made for another gap
    coupling->solve(step, target);
    step.flow_seconds = Timers::seconds_since(start) - step.contact_seconds;
  }

  void
  LoadSweep::compare_with_threshold(Step &step) const
  {
    step.doubts.clear();
    const Threshold *threshold = threshold_of(step.slip_length);
    if (threshold == nullptr)
      return;
    const double reduced =
      1. - step.contact->nominal_pressure / threshold->critical_load();
    step.reduced_load = reduced;
    if (reduced > 0 && step.flow->constrictions)
      step.doubts = doubts_near_threshold({reduced,
                                           .5 * threshold->relative_width(),
                                           step.flow->constrictions->points_along},
                                          log);
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

  const std::vector<Jump> &
  LoadSweep::jumps() const
  {
    static const std::vector<Jump> none;
    return adhesive ? adhesive->jumps() : none;
  }

  std::size_t
  LoadSweep::memory_consumption() const
  {
    const std::size_t grid = adhesive  ? adhesive->memory_consumption()
                             : contact ? contact->memory_consumption()
                                       : given_gap.size() * sizeof(double);
    return grid + (flow ? flow->memory_consumption() : 0) +
           (coupling ? coupling->memory_consumption() : 0);
  }
} // namespace strait
