// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/coupled_stage.h>
#include <strait/flow/pressure_on_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  CoupledStage::CoupledStage(const Scene   &scene_,
                             ContactSolver &contact_,
                             FlowStage     &flow_,
                             Log           &log_)
    : scene(scene_)
    , contact(contact_)
    , flow(flow_)
    , log(log_)
    , feedback(scene.fluid.feedback, contact.layout())
    , continuation(contact.layout(), scene.fluid.direction)
  {
  }

  void
  CoupledStage::solve(Step &step, const double target)
  {
    // The bracket may ask for a finer mesh, whose pressure then differs a little.
    constexpr int max_meshes = 3;
    step.feedback.reset();
    step.contact_seconds = 0;
    FeedbackGoal goal;
    for (int mesh = 0; mesh < max_meshes; ++mesh)
      {
        iterate(step, target, goal);
        goal.goes_on = true;
        if (step.feedback->lifted_off ||
            !flow.certify(*step.flow, step.gap, step.slip_length))
          break;
      }
    if (step.feedback->undecided)
      step.flow->result.lower = 0; // it is closed at times
  }

  void
  CoupledStage::settle(Step &step, const double target)
  {
    iterate(step, target, {false, false});
  }

  void
  CoupledStage::iterate(Step &step, const double target, const FeedbackGoal &goal)
  {
    if (!step.feedback)
      step.feedback.emplace();
    if (!goal.goes_on)
      begin(target);
    try
      {
        const FeedbackResult result = feedback.solve(
          [&](const SlabField &assumed) { return round(step, target, assumed); },
          largest_pressure(),
          goal);
        step.feedback->converged  = result.converged;
        step.feedback->undecided  = result.undecided;
        step.feedback->fluid_load = mean(feedback.pressure());
        step.contact->iterations  = step.feedback->contact_iterations;
        step.contact->fft_pairs   = step.feedback->fft_pairs;
      }
    catch (const LiftedOff &)
      {
        lift_off(step, target);
      }
  }

  void
  CoupledStage::begin(const double target)
  {
    // What carried another load is not to lift this one off before it was tried.
    constexpr double largest_share = .99;
    const double     fluid_load    = mean(feedback.pressure());
    if (scene.contact.control == ContactControl::load && fluid_load >= target)
      for (double &pressure : feedback.pressure())
        pressure *= largest_share * target / fluid_load;
    pools.restart();
  }

  void
  CoupledStage::transfer(StateArchive &archive)
  {
    archive.field(feedback.pressure(), contact.layout());
    archive.value(has_continued);
  }

  double
  CoupledStage::largest_pressure() const
  {
    const double largest = std::max(std::abs(flow.fluid().inlet_pressure),
                                    std::abs(flow.fluid().outlet_pressure));
    return largest > 0 ? largest : 1.;
  }

  FeedbackRound
  CoupledStage::round(Step &step, const double target, const SlabField &assumed)
  {
    if (scene.contact.control == ContactControl::load && mean(assumed) >= target)
      throw LiftedOff();
    const auto start = Timers::Clock::now();
    contact.set_fluid_pressure(assumed);
    step.contact  = contact.solve(target);
    step.gap      = step.contact->gap;
    step.mean_gap = step.contact->mean_gap;
    step.contact_seconds += Timers::seconds_since(start);
    ++step.feedback->iterations;
    step.feedback->contact_iterations += step.contact->iterations;
    step.feedback->fft_pairs += step.contact->fft_pairs;

    if (!step.flow)
      step.flow.emplace();
    flow.follow(*step.flow, step.gap, step.slip_length);

    FeedbackRound result;
    result.percolates     = step.flow->clusters.percolates;
    result.leak_rate      = step.flow->result.upper;
    result.fluid_pressure = pressure_in(step, assumed);
    log.progress(format("  feedback: fluid load %.5g, leak rate %.5g",
                        mean(result.fluid_pressure),
                        result.leak_rate));
    return result;
  }

  SlabField
  CoupledStage::pressure_in(const Step &step, SlabField start)
  {
    const std::vector<NodeState> &states = step.flow->clusters.states;
    pools.note(states);
    SlabField               open_gap = FlowStage::seen_gap(step.gap, step.slip_length);
    const double            inlet    = flow.fluid().inlet_pressure;
    const double            drop     = inlet - flow.fluid().outlet_pressure;
    const SlabLayoutPtr    &layout   = start.layout_pointer();
    const GridDeposit::Sums channel  = step.flow->solver
                                         ? pressure_on_grid(*step.flow->solver, layout)
                                         : GridDeposit::Sums();
    for (std::size_t k = 0; k < start.size(); ++k)
      switch (pools.contains(k) ? NodeState::closed : states[k])
        {
          case NodeState::percolating:
            // On the seam the channel may reach one side only; see extend().
            start[k] = channel.area.empty() || channel.area[k] == 0
                         ? inlet
                         : inlet - drop * (1. - channel.integral[k] / channel.area[k]);
            break;
          case NodeState::inlet_side:
            start[k] = inlet;
            break;
          case NodeState::outlet_side:
            start[k] = flow.fluid().outlet_pressure;
            break;
          case NodeState::pocket:
          case NodeState::outside: // there is none of them in the box
            start[k] = scene.fluid.feedback.pool_pressure;
            break;
          case NodeState::closed:
            if (!has_continued)
              start[k] = .5 * (inlet + flow.fluid().outlet_pressure);
            open_gap[k] = std::min(open_gap[k], 0.);
            break;
        }
    has_continued = true;
    continuation.extend(start, open_gap, inlet, flow.fluid().outlet_pressure);
    return start;
  }

  void
  CoupledStage::lift_off(Step &step, const double target) const
  {
    constexpr double     infinite = std::numeric_limits<double>::infinity();
    const SlabLayoutPtr &layout   = contact.layout();
    step.contact.emplace();
    step.contact->pressure         = SlabField(layout);
    step.contact->nominal_pressure = target;
    step.contact->converged        = true;
    step.contact->mean_gap = step.mean_gap = infinite;
    step.contact->gap = step.gap = SlabField(layout, infinite);
    step.flow.emplace();
    step.flow->clusters.percolates = true;
    step.flow->clusters.states.assign(step.gap.size(), NodeState::percolating);
    step.flow->result.leak_rate = step.flow->result.upper = infinite;
    step.feedback->lifted_off                             = true;
    step.feedback->fluid_load                             = target;
    log.warn(
      format("the fluid alone carries a load of %.6g: the walls part and nothing "
             "limits the leak",
             target));
  }
} // namespace strait
