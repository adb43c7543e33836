// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/load_sweep.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace strait
{
  namespace
  {
    // Below this share of the narrowest point's conductivity the fluid is taken to
    // be stopped, in the lower bound only.
    constexpr double       floor_share    = 1e-8;
    constexpr unsigned int n_paths_wanted = 3;

    double
    seconds_since(const Timers::Clock::time_point start)
    {
      return std::chrono::duration<double>(Timers::Clock::now() - start).count();
    }

    template <typename... Arguments>
    std::string
    format(const char *pattern, Arguments... arguments)
    {
      char text[256];
      std::snprintf(text, sizeof text, pattern, arguments...);
      return text;
    }
  } // namespace

  LoadSweep::LoadSweep(const Scene &scene_, SlabField heights, Log &log_, Timers &timers_)
    : scene(scene_)
    , log(log_)
    , timers(timers_)
  {
    if (scene.fluid.enabled)
      gap_field = std::make_unique<GapField>(heights.layout_pointer(), scene.fluid);
    if (scene.contact.enabled)
      contact = std::make_unique<ContactSolver>(scene.contact, std::move(heights));
    else
      given_gap = std::move(heights);
  }

  bool
  LoadSweep::run(const Consumer &consume)
  {
    const std::vector<double> targets =
      contact ? scene.programme.pressures : std::vector<double>{0.};
    const int n_steps   = static_cast<int>(targets.size());
    bool      converged = true;
    for (int k = 0; k < n_steps; ++k)
      {
        Step step;
        step.number = k + 1;
        press(step, targets[k]);
        leak(step);
        converged = converged && step.status() == "ok";
        report_step(step, n_steps);
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

    const SlabField seen = gap_seen_by_fluid(step.gap);
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
        flow.result = solver->run([this](const FlowResult &now) { report_flow(now); });
        flow.solver = std::move(solver);
      }
    step.flow_seconds = seconds_since(start);
  }

  SlabField
  LoadSweep::gap_seen_by_fluid(const SlabField &gap) const
  {
    SlabField seen = gap;
    if (scene.fluid.slip_length != 0)
      for (double &value : seen)
        value += 2. * scene.fluid.slip_length;
    return seen;
  }

  void
  LoadSweep::report_flow(const FlowResult &flow) const
  {
    log.progress(format("  flow: mesh %u, %llu cells, leak rate between %.4g and %.4g",
                        flow.refinements + 1,
                        flow.cells,
                        flow.lower,
                        flow.upper));
  }

  void
  LoadSweep::report_step(const Step &step, const int n_steps) const
  {
    std::string text = format("step %d of %d", step.number, n_steps);
    if (step.contact)
      text +=
        format(": pressure %.5g, contact %.3f %%, residual %.1e (%ld FFT pairs, %.1f s)",
               step.contact->nominal_pressure,
               100. * step.contact->contact_area,
               step.contact->residual,
               step.contact->fft_pairs,
               step.contact_seconds);
    if (step.flow && step.flow->clusters.percolates)
      text += format("; leak rate %.5g ± %.1g %% (%llu cells, %.1f s)",
                     step.flow->result.leak_rate,
                     50. * step.flow->result.relative_width(),
                     step.flow->result.cells,
                     step.flow_seconds);
    else if (step.flow)
      text += "; sealed";
    if (step.status() != "ok")
      text += "; " + step.status();
    log.line(text);
    if (step.number < n_steps)
      log.progress(format("  about %.0f s remain",
                          timers.total() / step.number * (n_steps - step.number)));
  }

  std::size_t
  LoadSweep::memory_consumption() const
  {
    return (contact ? contact->memory_consumption() : given_gap.size() * sizeof(double)) +
           (gap_field ? gap_field->memory_consumption() : 0);
  }
} // namespace strait
