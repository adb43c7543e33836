// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/load_sweep.h>
#include <strait/driver/step_report.h>
#include <strait/percolation/percolating_gap.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <chrono>

namespace strait
{
  namespace
  {
    // The lower bound divides by the conductivity, which is therefore taken to be no
    // smaller than this share of the narrowest point's, in contact as well: that lets
    // the bound leak a little, by about this share times width over length.
    constexpr double       floor_share    = 1e-8;
    constexpr unsigned int n_paths_wanted = 3;

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
      {
        gap_field    = std::make_unique<GapField>(heights.layout_pointer(), scene.fluid);
        error_budget = std::make_unique<ErrorBudget>(scene, heights);
      }
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
  }

  const std::vector<Threshold> &
  LoadSweep::find_thresholds()
  {
    const auto      scope = timers.scope("threshold");
    ThresholdSearch search([this](const double load) { return probe(load); },
                           first_guess,
                           scene.programme.threshold_tolerance);
    for (const double slip_length : scene.fluid.slip_lengths)
      {
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

  ThresholdProbe
  LoadSweep::probe(const double load)
  {
    const ContactState  state = contact->solve(load);
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
        if (k > 0 && stops[k].target == stops[k - 1].target)
          step.contact_seconds = 0.; // another slip length in the same gap
        else
          press(step, stops[k].target);
        leak(step);
        compare_with_threshold(step);
        step.errors = step.flow && step.flow->clusters.percolates
                        ? error_budget->assess(step)
                        : StepErrors();
        converged   = converged && step.converged();
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
    if (!gap_field)
      return;
    const auto scope = timers.scope("flow");
    const auto start = Timers::Clock::now();
    StepFlow  &flow  = step.flow.emplace();

    const SlabField seen = gap_seen_by_fluid(step);
    flow.clusters        = find_clusters(seen, scene.fluid.direction);
    if (flow.clusters.percolates)
      {
        const SlabField open =
          percolating_gap(seen, flow.clusters, scene.fluid.direction);
        {
          const auto path_scope = timers.scope("paths");
          flow.paths = find_flow_paths(open, scene.fluid.direction, n_paths_wanted);
        }
        {
          const auto   bridge_scope = timers.scope("bridge");
          const double narrowest    = flow.paths.front().bottleneck_gap;
          gap_field->update(open, floor_share * gap_field->conductivity_of(narrowest));
        }
        const auto solver_scope = timers.scope("mesh and solver");
        auto       solver =
          std::make_unique<ReynoldsSolver>(scene.fluid, *gap_field, flow.paths);
        flow.result =
          solver->run([this](const FlowResult &now) { report_flow(now, log); });
        if (!flow.result.reason.empty())
          log.warn(format("the leak rate is known to %.1f %% only because %s",
                          50. * flow.result.relative_width(),
                          flow.result.reason.c_str()));
        flow.solver = std::move(solver);
        if (scene.programme.find_threshold)
          flow.constrictions =
            report_constrictions(seen, flow.paths.front(), *flow.solver);
      }
    step.flow_seconds = seconds_since(start);
  }

  void
  LoadSweep::compare_with_threshold(Step &step) const
  {
    step.remark.clear();
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
        step.remark = "uncertain-threshold";
        log.warn(
          format("at a reduced load of %.3g the critical load, known to %.1e, is too "
                 "uncertain: a threshold tolerance of %.1e would do",
                 reduced,
                 uncertainty,
                 2. * reduced / load_errors_needed));
      }
    else if (!(points >= points_needed))
      {
        step.remark = "unresolved-throat";
        log.warn(
          format("at a reduced load of %.3g the throat has %.2g grid points along it, "
                 "%.0f are needed: a grid finer by a factor of %.2g would do",
                 reduced,
                 points,
                 points_needed,
                 points_needed / points));
      }
  }

  SlabField
  LoadSweep::gap_seen_by_fluid(const Step &step) const
  {
    SlabField seen = step.gap;
    for (double &value : seen)
      value += 2. * step.slip_length;
    return seen;
  }

  std::size_t
  LoadSweep::memory_consumption() const
  {
    return (contact ? contact->memory_consumption() : given_gap.size() * sizeof(double)) +
           (gap_field ? gap_field->memory_consumption() : 0);
  }
} // namespace strait
