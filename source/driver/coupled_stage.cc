// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/coupled_stage.h>
#include <strait/flow/solution_on_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace strait
{
  namespace
  {
    // How closely contact and flow agree while the mesh is being found, of the accuracy
    // that is asked for.
    constexpr double looseness = .1;

    // How much smaller than the target accuracy the width of the bracket is on the first
    // mesh, and how much on each mesh than on the one before: the gap amplifies the
    // errors of the fluid's pressure, the more so the closer it is to the threshold.
    constexpr double mesh_share = .25;
  } // namespace

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
    step.feedback.reset();
    step.contact_seconds = 0;
    FeedbackGoal goal{
      std::max(scene.fluid.feedback.tolerance, looseness * flow.fluid().target_accuracy)};
    const double share = find_mesh(step, target, goal);
    if (step.feedback->lifted_off)
      return;
    goal.tolerance = scene.fluid.feedback.tolerance;
    if (step.feedback->converged && !last_result.agrees_within(goal))
      iterate(step, target, goal);
    if (step.flow->solution)
      {
        flow.certify(*step.flow, share);
        allow_for_mesh(step);
      }
  }

  /**
   * Let contact and flow come near each other on finer and finer meshes until the leak
   * rate does not depend on the mesh that the fluid's pressure on the wall is found on.
   * Returns the share of the target accuracy that the last of them is for.
   */
  double
  CoupledStage::find_mesh(Step &step, const double target, FeedbackGoal &goal)
  {
    // If the leak rate changes by more than that, contact and flow went to another
    // state, for which another mesh of this share is wanted.
    constexpr double      another_state = .5;
    constexpr int         max_finer = 2, max_states = 4;
    double                share = mesh_share;
    std::optional<double> leak_before;
    for (int finer = 0, states = 1;;)
      {
        iterate(step, target, goal);
        goal.goes_on = true;
        if (!step.feedback->converged || !step.flow->solution)
          break;
        bool stays = true;
        if (leak_before)
          {
            flow.certify(*step.flow, share);
            // A change below the width of the bracket, or below what the iteration leaves
            // over, is chance.
            const Leakage &now        = step.flow->leakage;
            step.feedback->mesh_error = std::max({std::abs(*leak_before / now.rate - 1.),
                                                  .5 * now.relative_width(),
                                                  goal.tolerance});
            stays                     = step.feedback->mesh_error <= another_state;
            const bool is_narrow =
              now.relative_width() + 2. * step.feedback->mesh_error <=
              flow.fluid().target_accuracy;
            if (is_narrow || (stays ? finer == max_finer : states == max_states))
              break;
          }
        if (stays)
          {
            ++finer;
            share *= mesh_share;
          }
        else
          {
            ++states;
            flow.discard_mesh();
          }
        flow.certify(*step.flow, share);
        leak_before = step.flow->leakage.rate;
      }
    return share;
  }

  /** Widen the bracket of the leak rate, which is that of the gap that was found, by what
   *  the last mesh changed through the gap. */
  void
  CoupledStage::allow_for_mesh(Step &step) const
  {
    Leakage     &result = step.flow->leakage;
    const double error  = step.feedback->mesh_error;
    result.lower *= std::max(0., 1. - error);
    result.upper *= 1. + error;
    if (step.feedback->undecided)
      result.lower = 0; // it is closed at times
    else if (result.status == "ok" &&
             result.relative_width() > flow.fluid().target_accuracy)
      {
        result.status = "flow-accuracy";
        result.reason = "the fluid's pressure on the wall still changes with the mesh";
        flow.warn_of_width(result);
      }
  }

  void
  CoupledStage::settle(Step &step, const double target)
  {
    // The verdict should not depend on what the iteration leaves over, but below that it
    // is what contact and flow leave over that counts.
    constexpr double least = 1e-5;
    FeedbackGoal     goal{
      std::min(scene.fluid.feedback.tolerance,
               std::max(.1 * scene.programme.threshold_tolerance, least))};
    goal.leak_rate = false;
    iterate(step, target, goal);
  }

  void
  CoupledStage::iterate(Step &step, const double target, FeedbackGoal goal)
  {
    if (scene.contact.control == ContactControl::load)
      goal.largest_mean = target;
    if (!step.feedback)
      step.feedback.emplace();
    if (!goal.goes_on)
      begin(target);
    try
      {
        last_result = feedback.solve(
          [&](const SlabField &assumed) { return round(step, target, assumed); },
          largest_pressure(),
          goal);
        step.feedback->converged  = last_result.converged;
        step.feedback->undecided  = last_result.undecided;
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
    flow.follow(*step.flow, step.gap, step.slip_length, mesh_share);

    FeedbackRound result;
    result.percolates     = step.flow->channel.percolates();
    result.leak_rate      = step.flow->leakage.upper;
    result.fluid_pressure = pressure_in(step, assumed);
    log.progress(format("  feedback: fluid load %.5g, leak rate %.5g",
                        mean(result.fluid_pressure),
                        result.leak_rate));
    return result;
  }

  SlabField
  CoupledStage::pressure_in(const Step &step, SlabField start)
  {
    const std::vector<NodeState> &states = step.flow->channel.clusters.states;
    pools.note(states);
    SlabField               open    = open_gap(step.gap, step.slip_length);
    const double            inlet   = flow.fluid().inlet_pressure;
    const double            drop    = inlet - flow.fluid().outlet_pressure;
    const SlabLayoutPtr    &layout  = start.layout_pointer();
    const GridDeposit::Sums channel = step.flow->solution
                                        ? pressure_on_grid(*step.flow->solution, layout)
                                        : GridDeposit::Sums();
    for (std::size_t k = 0; k < start.size(); ++k)
      switch (pools.contains(k) ? pools.state_before(k) : states[k])
        {
          case NodeState::percolating:
            if (pools.contains(k))
              break; // it keeps what it had when it was cut off
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
          case NodeState::trapped:
          case NodeState::outside: // there is none of them in the box
            start[k] = scene.fluid.feedback.pool_pressure;
            break;
          case NodeState::closed:
            if (!has_continued)
              start[k] = .5 * (inlet + flow.fluid().outlet_pressure);
            open[k] = std::min(open[k], 0.);
            break;
        }
    has_continued = true;
    // The next round starts from here, so that no more is needed than to come nearer.
    constexpr double reduction = 1e-3;
    continuation.extend(start, open, inlet, flow.fluid().outlet_pressure, reduction);
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
    step.flow->channel.clusters.percolates = true;
    step.flow->channel.clusters.states.assign(step.gap.size(), NodeState::percolating);
    step.flow->leakage.rate = step.flow->leakage.upper = infinite;
    step.feedback->lifted_off                          = true;
    step.feedback->fluid_load                          = target;
    log.warn(
      format("the fluid alone carries a load of %.6g: the walls part and nothing "
             "limits the leak",
             target));
  }
} // namespace strait
