// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/base/timers.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/seal/coupled_seal.h>
#include <strait/seal/wall_feedback.h>
#include <strait/seal/wall_pressure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace strait
{
  namespace
  {
    // How closely contact and flow agree while the mesh is being found, and for a
    // verdict, of the accuracy that is asked for. Half of it takes more rounds on meshes
    // that are left again; with double of it what the rounds leave over is taken for an
    // error of the mesh.
    constexpr double looseness = .1;

    struct LiftedOff
    {
    };
  } // namespace

  /** The way to one state. */
  class CoupledSeal::Iteration
  {
  public:
    Iteration(CoupledSeal &seal, const Control &control, const SealState *from);

    /** Contact and flow that agree to the accuracy of a verdict. */
    void settle();

    /** The same to that of a leak rate. */
    void find_mesh();

    SealState state;

    std::size_t
    memory_consumption() const
    {
      return feedback.memory_consumption() + wall_pressure.memory_consumption();
    }

  private:
    bool          is_limited_by_load() const;
    void          agree(FeedbackGoal goal);
    FeedbackRound round(const SlabField &assumed);
    void          lift_off();

    CoupledSeal        &seal;
    const Control       control;
    const bool          has_parted; // walls that no load joins but one that presses
    const SealState    *from;       // null where the past does not matter
    const ContactState *near;       // that the next contact starts from, if there is one
    FlowStage          &flow;
    StepFlow            fluid_flow;
    WallFeedback        feedback;
    WallPressure        wall_pressure;
    FeedbackResult      last_result;
    int                 n_iterations = 0;
    long                fft_pairs    = 0;
  };

  CoupledSeal::CoupledSeal(const Scene                  &scene_,
                           std::unique_ptr<ContactModel> contact_,
                           const SlabLayoutPtr          &layout_,
                           FlowStage                    &flow_,
                           Log                          &log_)
    : scene(scene_)
    , contact(std::move(contact_))
    , layout(layout_)
    , flow(flow_)
    , log(log_)
    , extension(layout, scene.fluid.direction)
  {
  }

  SealState
  CoupledSeal::solve(const Control &control, const SealState *from, const Aim aim)
  {
    flow.set_inlet_pressure(control.inlet_pressure);
    Iteration iteration(*this, control, from);
    if (aim == Aim::verdict)
      iteration.settle();
    else
      iteration.find_mesh();
    peak_memory = std::max(peak_memory, iteration.memory_consumption());
    return std::move(iteration.state);
  }

  std::size_t
  CoupledSeal::memory_consumption() const
  {
    return contact->memory_consumption() + peak_memory;
  }

  CoupledSeal::Iteration::Iteration(CoupledSeal     &seal_,
                                    const Control   &control_,
                                    const SealState *from_)
    : seal(seal_)
    , control(control_)
    , has_parted(from_ != nullptr && from_->fluid->lifted_off)
    , from(has_parted ? nullptr : from_)
    , near(from != nullptr ? &*from->contact : nullptr)
    , flow(seal.flow)
    , feedback(seal.scene.fluid.feedback, seal.layout)
    , wall_pressure(seal.extension,
                    seal.scene.fluid.feedback.pool_pressure,
                    from != nullptr)
  {
    state.control = control;
    state.fluid.emplace();
    if (from == nullptr)
      return;
    feedback.pressure() = from->fluid->pressure;
    // What carried a larger load is not to lift this one off before it was tried.
    if (is_limited_by_load() && mean(feedback.pressure()) >= control.target)
      for (double &pressure : feedback.pressure())
        pressure *= control.target / from->control.target;
  }

  /** Whether the fluid cannot carry more than the load: adhesion could hold against it.
   */
  bool
  CoupledSeal::Iteration::is_limited_by_load() const
  {
    return seal.scene.contact.control == ContactControl::load &&
           !seal.scene.contact.adhesion.enabled;
  }

  void
  CoupledSeal::Iteration::settle()
  {
    // The verdict should not depend on what the iteration leaves over.
    FeedbackGoal goal{std::min(seal.scene.fluid.feedback.tolerance,
                               looseness * seal.scene.programme.threshold_tolerance)};
    goal.leak_rate = false;
    agree(goal);
  }

  /**
   * Let contact and flow come near each other on finer and finer meshes until the leak
   * rate does not depend on the mesh that the fluid's pressure on the wall is found on,
   * and then agree.
   */
  void
  CoupledSeal::Iteration::find_mesh()
  {
    // For one state, and for others that it leads to. Half as many may leave the leak
    // rate to change with the mesh, which the bracket then says; twice as many cost more
    // for gaps that no mesh settles.
    constexpr int max_meshes = 4;

    const double target_accuracy = flow.fluid().target_accuracy;
    const double tolerance       = seal.scene.fluid.feedback.tolerance;
    FluidState  &fluid           = *state.fluid;
    FeedbackGoal goal{std::max(tolerance, looseness * target_accuracy)};
    double       share = mesh_share;

    std::optional<double> leak_before;
    for (int n_meshes = 1;; ++n_meshes)
      {
        agree(goal);
        goal.goes_on = true;
        if (fluid.lifted_off)
          return;
        if (!fluid.converged || !fluid_flow.solution)
          break;
        bool is_another = false;
        if (leak_before)
          {
            // A mesh for another state is compared once the fluid has been found on it.
            is_another         = flow.certify(fluid_flow, share);
            const Leakage &now = fluid_flow.leakage;
            // A change below the width of the bracket, or below what the iteration leaves
            // over, is chance.
            fluid.mesh_error = std::max({std::abs(*leak_before / now.rate - 1.),
                                         .5 * now.relative_width(),
                                         goal.tolerance});
            const bool is_narrow =
              now.relative_width() + 2. * fluid.mesh_error <= target_accuracy;
            if (is_narrow || n_meshes == max_meshes)
              break;
          }
        if (!is_another)
          {
            share *= mesh_share;
            flow.certify(fluid_flow, share);
          }
        leak_before = fluid_flow.leakage.rate;
      }
    goal.tolerance = tolerance;
    if (fluid.converged && !last_result.agrees_within(goal))
      agree(goal);
  }

  void
  CoupledSeal::Iteration::agree(FeedbackGoal goal)
  {
    if (is_limited_by_load())
      goal.largest_mean = control.target;
    if (from != nullptr)
      goal.percolates = from->fluid->percolates;
    FluidState  &fluid   = *state.fluid;
    const double largest = std::max(std::abs(flow.fluid().inlet_pressure),
                                    std::abs(flow.fluid().outlet_pressure));
    try
      {
        last_result =
          feedback.solve([&](const SlabField &assumed) { return round(assumed); },
                         largest > 0 ? largest : 1.,
                         goal);
        fluid.converged           = last_result.converged;
        fluid.undecided           = last_result.undecided;
        fluid.percolates          = fluid_flow.channel.percolates();
        fluid.load                = mean(feedback.pressure());
        state.contact->iterations = n_iterations;
        state.contact->fft_pairs  = fft_pairs;
      }
    catch (const LiftedOff &)
      {
        lift_off();
      }
    fluid.pressure = feedback.pressure();
  }

  FeedbackRound
  CoupledSeal::Iteration::round(const SlabField &assumed)
  {
    if ((is_limited_by_load() && mean(assumed) >= control.target) ||
        (has_parted && !(control.target > 0.)))
      throw LiftedOff();
    const auto   start = Timers::Clock::now();
    ContactState next  = seal.contact->solve(control.target, near, &assumed);
    if (next.adhesion && next.adhesion->detached)
      throw LiftedOff();
    state.contact  = std::move(next);
    near           = &*state.contact;
    state.mean_gap = state.contact->mean_gap;
    state.contact_seconds += Timers::seconds_since(start);
    ++state.fluid->rounds;
    n_iterations += state.contact->iterations;
    fft_pairs += state.contact->fft_pairs;

    flow.follow(fluid_flow, state.contact->gap, control.slip_length, mesh_share);

    FeedbackRound result;
    result.percolates     = fluid_flow.channel.percolates();
    result.leak_rate      = fluid_flow.leakage.upper;
    result.fluid_pressure = assumed;
    wall_pressure.update(result.fluid_pressure,
                         fluid_flow,
                         open_gap(state.contact->gap, control.slip_length),
                         flow.fluid());
    seal.log.progress(format("  feedback: fluid load %.5g, leak rate %.5g",
                             mean(result.fluid_pressure),
                             result.leak_rate));
    return result;
  }

  void
  CoupledSeal::Iteration::lift_off()
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    ContactState    &contact  = state.contact.emplace();
    contact.pressure          = SlabField(seal.layout);
    contact.gap               = SlabField(seal.layout, infinite);
    contact.nominal_pressure  = control.target;
    contact.converged         = true;
    if (seal.scene.contact.adhesion.enabled)
      contact.adhesion.emplace();
    contact.mean_gap = state.mean_gap = infinite;
    state.fluid->lifted_off           = true;
    state.fluid->converged            = false;
    state.fluid->load                 = control.target;
    seal.log.warn(format(has_parted && !(control.target > 0.)
                           ? "the walls have parted, and a load of %.6g does not join "
                             "them: nothing limits the leak"
                           : "the fluid alone carries a load of %.6g: the walls part and "
                             "nothing limits the leak",
                         control.target));
  }
} // namespace strait
