// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/run/load_sweep.h>
#include <strait/seal/make_seal.h>

#include <algorithm>
#include <cmath>
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
    , surface(statistics(heights))
    , contact(complete_contact(scene, heights, surface_energy, log))
    , coarser(scene, contact, heights, log)
  {
    done.surface_energy = contact.adhesion.surface_energy;
    if (scene.fluid.enabled)
      flow = std::make_unique<FlowStage>(scene.fluid, layout, log, timers);
    if (scene.theory.enabled)
      theory = std::make_unique<TheoryPrediction>(scene, &heights);
    path.emplace(scene, make_seal(scene, contact, std::move(heights), flow.get(), log));
    if (scene.programme.find_threshold || scene.programme.find_blow_out)
      seal_search =
        std::make_unique<SealSearch>(scene, path->model, layout, flow->domain(), log);
  }

  void
  LoadSweep::end_searches()
  {
    seal_search.reset();
    coarser.end_searches();
  }

  const std::vector<Transition> &
  LoadSweep::find_thresholds()
  {
    const auto        scope = timers.scope("threshold");
    const SearchStart first =
      coarser.find_critical_loads(search_start(scene, contact, surface.rms_slope));
    log.stage("critical load");
    done.thresholds = seal_search->find_critical_loads(first);
    for (Transition &threshold : done.thresholds)
      {
        done.converged = done.converged && threshold.converged;
        if (std::isinf(threshold.grid_error))
          continue; // in a crease, of which the search has warned
        coarser.complete_grid_error(threshold);
        if (!std::isnan(threshold.grid_error))
          log.line(format("finer points may have the critical load %.2g %% from there",
                          100. * threshold.grid_error));
      }
    path->begin_after(*seal_search);
    return done.thresholds;
  }

  std::vector<BlowOut>
  LoadSweep::find_blow_outs()
  {
    const auto scope = timers.scope("blow-out");
    log.stage("blow-out pressure");
    std::vector<BlowOut> found = seal_search->find_blow_outs();
    coarser.estimate_grid_errors(found);
    for (const BlowOut &blow_out : found)
      done.converged = done.converged && blow_out.opening.converged &&
                       (!blow_out.closing || blow_out.closing->converged);
    return found;
  }

  bool
  LoadSweep::run(const Consumer &consume)
  {
    const std::vector<LoadStop> stops   = plan_stops(scene, done.thresholds);
    const int                   n_known = done.n_done;
    const auto                  begin   = Timers::Clock::now();
    while (done.n_done < n_steps())
      {
        const auto      here       = stops.begin() + done.n_done + done.n_left_out;
        const LoadStop &stop       = *here;
        const int       n_measured = done.n_done - n_known;
        step.number                = done.n_done + 1;
        step.branch                = stop.branch;
        announce_step(step.number,
                      n_steps(),
                      n_measured > 0 ? Timers::seconds_since(begin) / n_measured : 0.,
                      log);
        if (!press(stop))
          {
            const auto next_path =
              std::find_if(here + 1, stops.end(), [](const LoadStop &later) {
                return later.starts_new_path;
              });
            const auto n_left_out = static_cast<int>(next_path - here);
            log.warn(
              format("the surfaces part before the pressure %.6g: "
                     "steps left out: %d",
                     stop.target,
                     n_left_out));
            done.n_left_out += n_left_out;
            continue;
          }
        if (scene.depends_on_path() && coarser.size() > 0)
          {
            const auto scope = timers.scope("errors");
            coarser.advance_to(stop, threshold_of(done.thresholds, stop.slip_length));
          }
        leak();
        judge(stop);
        report_step(step, n_steps(), log);
        ++done.n_done;
        consume(step);
      }
    log.stage("");
    return done.converged;
  }

  /** Follow the path to @p stop. Return false if the surfaces part before. */
  bool
  LoadSweep::press(const LoadStop &stop)
  {
    const Control control{stop.target, scene.fluid.inlet_pressure, stop.slip_length};
    step.dissipated_energy = 0.;
    const auto start_time  = Timers::Clock::now();
    const auto scope =
      timers.scope(scene.fluid.feedback.enabled ? "coupling" : "contact");
    const StepRule rule = step_rule(scene, stop.largest_on_path);
    step.flow.reset(); // its mesh was made for another gap
    if (flow)
      flow->release();
    std::optional<SealState> last;
    if (done.n_done > 0 && !step.state.gap().empty())
      last = std::move(step.state);
    Arrival arrival = path->advance_to(stop,
                                       control,
                                       std::move(last),
                                       flow ? Aim::leak_rate : Aim::verdict);
    for (const Jump &jump : arrival.jumps)
      {
        log.line(describe(jump));
        if (rule.jump_tolerance > 0. && jump.width() > rule.jump_tolerance)
          log.warn(
            "steps with many jumps are left before all are as narrow as Load "
            "programme/Jump tolerance; list more Pressures there");
        step.dissipated_energy += jump.dissipated;
        done.jumps.push_back(jump);
      }
    if (!arrival.state)
      return false;
    step.state = std::move(*arrival.state);
    // With wall feedback, most of the flow is solved on the way to the stop.
    step.flow_seconds =
      Timers::seconds_since(start_time) - step.state.costs.contact_seconds;
    return true;
  }

  /** Find the channel that percolates and solve the flow in it. */
  void
  LoadSweep::leak()
  {
    if (!flow)
      return;
    const auto scope = timers.scope("flow");
    const auto start = Timers::Clock::now();
    step.flow        = leak_through(step.state, scene, *flow);
    if (scene.programme.find_threshold && step.flow->solution)
      step.flow->constrictions =
        report_constrictions(step.flow->channel, *step.flow->solution);
    if (scene.has_two_boxes())
      {
        const SlabField two = two_in_a_row(step.state.gap());
        FlowStage       row(scene.fluid, two.layout_pointer(), log, timers);
        step.two_boxes = row.solve(two, step.state.control.slip_length).leakage;
      }
    step.flow_seconds += Timers::seconds_since(start);
  }

  /** Judge the step: doubts, theory, errors and limits of the model. */
  void
  LoadSweep::judge(const LoadStop &stop)
  {
    const Transition *threshold = threshold_of(done.thresholds, stop.slip_length);
    const double      pressure =
      step.state.contact ? step.state.contact->nominal_pressure : 0.;
    step.doubts.clear();
    step.reduced_load.reset();
    // A seal that depends on its past has another critical load once it has turned back.
    if (threshold != nullptr && (!scene.depends_on_path() || stop.goes_further))
      {
        step.reduced_load = 1. - pressure / threshold->middle();
        step.doubts =
          doubts_near_threshold(step, *threshold, scene.contact.zoom.enabled, log);
      }
    if (theory)
      {
        const auto scope = timers.scope("theory");
        step.theory =
          theory->predict(pressure, stop.slip_length, &step.state.gap(), threshold);
      }
    step.errors = StepErrors();
    if (step.flow && step.flow->solution)
      {
        const auto scope = timers.scope("errors");
        step.errors      = assess_errors(step,
                                    stop.is_reduced ? threshold : nullptr,
                                    scene,
                                    surface.rms_height,
                                    *flow,
                                    coarser);
      }
    if (scene.contact.zoom.enabled && !step.errors.items.empty() &&
        !(step.errors.sum() <= scene.fluid.target_accuracy))
      step.doubts.emplace_back("inaccurate");
    judge_validity(step, scene, surface.rms_slope, log);
    done.converged = done.converged && step.converged();
  }

  void
  LoadSweep::transfer(StateArchive &archive)
  {
    archive.values(
      done.thresholds, done.n_done, done.n_left_out, done.converged, done.jumps);
    bool is_searching = seal_search != nullptr;
    archive.value(is_searching);
    if (is_searching)
      seal_search->transfer(archive);
    else
      end_searches();
    path->transfer(archive, layout);
    if (!scene.contact.enabled) // a given gap has no past
      return;
    coarser.transfer(archive);
    if (done.n_done > 0)
      strait::transfer(archive, step.state, layout);
  }
} // namespace strait
