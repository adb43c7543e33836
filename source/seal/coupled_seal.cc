// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/iteration.h>
#include <strait/base/text.h>
#include <strait/base/timers.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/seal/fluid_on_wall.h>
#include <strait/seal/seal_models.h>
#include <strait/seal/wall_feedback.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace strait
{
  namespace
  {
    // Of the change that a round makes, in rounds that are to keep a state. With three
    // times of it they lose more states that are there, half of it takes more rounds.
    constexpr double small_fraction = .1;

    // Times that a state is given up for another one, or that regions meet in it. Half as
    // many give long steps up on which they meet one after the other, twice as many go on
    // where they meet and part, or the leak rate changes with the mesh, without end.
    constexpr int most_tries = 4;

    struct LiftedOff
    {
    };

    /** The way to one state, with a fraction of the changes that relaxation takes. */
    class Coupling
    {
    public:
      Coupling(const Scene         &scene_,
               ContactModel        &contact_,
               const SlabLayoutPtr &layout_,
               FlowStage           &flow_,
               Log                 &log_,
               const Control       &control_,
               const SealState     *from,
               const double         fraction)
        : scene(scene_)
        , contact(contact_)
        , layout(from != nullptr ? from->contact->pressure.layout_pointer() : layout_)
        , flow(flow_)
        , log(log_)
        , control(control_)
        , near(from != nullptr && !(from->fluid && from->fluid->lifted_off)
                 ? &*from->contact
                 : nullptr)
        , feedback(scene.fluid.feedback, layout, fraction)
        , on_wall(scene, control, from)
        , mesh_accuracy(mesh_fraction * scene.fluid.target_accuracy)
      {
        state.control = control;
        state.fluid.emplace();
        if (from == nullptr || !from->fluid)
          return;
        feedback.pressure() = from->fluid->pressure;
        // What carried another load is not to lift this one off before it was tried.
        const double fluid_load = mean(feedback.pressure());
        if (on_wall.is_limited_by_load() && fluid_load >= control.target)
          for (double &pressure : feedback.pressure())
            pressure *= FluidOnWall::largest_fraction * control.target / fluid_load;
      }

      /** Contact and flow that agree to what @p aim needs; see FeedbackGoal if only one
       * @p verdict is wanted. */
      SealState
      reach(const Aim aim, const std::optional<bool> verdict)
      {
        if (aim != Aim::leak_rate || verdict)
          settle(aim == Aim::seal, verdict);
        if (aim == Aim::leak_rate && (!verdict || state.fluid->converged))
          find_mesh();
        return std::move(state);
      }

    private:
      /** Contact and flow that agree to the accuracy of a verdict; roughly, on a rough
       * mesh, if the channel is open and @p open_is_enough. */
      void
      settle(const bool open_is_enough, const std::optional<bool> verdict)
      {
        // The verdict should not depend on what the iteration leaves over, but below that
        // it is what contact and flow leave over that counts. Half of it takes a few
        // rounds more, double of it blurs the tightest thresholds that can be asked for.
        constexpr double least    = 1e-5;
        const double     fraction = looseness * scene.programme.threshold_tolerance;
        FeedbackGoal     goal{std::min(scene.fluid.feedback.tolerance,
                                   std::max(fraction, least)),
                          std::numeric_limits<double>::infinity()};
        goal.once_open = open_is_enough ? looseness : 0.;
        goal.verdict   = verdict;
        // The search for its re-sealing goes on from the state that has opened.
        if (open_is_enough && !scene.programme.find_resealing)
          mesh_accuracy = std::max(mesh_accuracy, looseness);
        agree(goal);
      }

      /**
       * Let contact and flow come near each other on finer and finer meshes until the
       * leak rate does not depend on the mesh that the fluid's pressure on the wall is
       * found on, and then agree.
       */
      void
      find_mesh()
      {
        // Of meshes for one state. Half as many may leave the leak rate to change with
        // the mesh, which the bracket then says; twice as many cost more for gaps that no
        // mesh settles.
        constexpr int max_finer = 2;
        // If the leak rate changes by more than that, contact and flow went to another
        // state, for which another mesh of this fraction is wanted.
        constexpr double another_state = 1. - 1. / FlowStage::another_gap;

        const double target_accuracy = flow.fluid().target_accuracy;
        const double tolerance       = scene.fluid.feedback.tolerance;
        FluidState  &fluid           = *state.fluid;
        const double loosely         = std::max(tolerance, looseness * target_accuracy);
        FeedbackGoal goal{loosely, loosely};
        double       fraction = mesh_fraction;

        std::optional<double> leak_before;
        for (int finer = 0, states = 1;;)
          {
            agree(goal);
            goal.goes_on = true;
            if (fluid.lifted_off)
              return;
            if (!fluid.converged || !fluid_flow.solution)
              break;
            bool stays = true;
            if (leak_before)
              {
                // A change below the width of the bracket, or below what the iteration
                // leaves over, is chance.
                const Leakage &now = flow.certify(fluid_flow, fraction);
                fluid.mesh_error   = std::max({std::abs(*leak_before / now.rate - 1.),
                                               .5 * now.relative_width(),
                                               loosely});
                stays              = fluid.mesh_error <= another_state;
                // The bracket of the row may take as much as that of the first mesh.
                const double width =
                  std::max(now.relative_width(), mesh_fraction * target_accuracy);
                const bool is_narrow = width + 2. * fluid.mesh_error <= target_accuracy;
                if (is_narrow || (stays ? finer == max_finer : states == most_tries))
                  break;
              }
            if (stays)
              {
                ++finer;
                fraction *= mesh_fraction;
              }
            else
              {
                ++states;
                flow.discard_mesh();
              }
            leak_before = flow.certify(fluid_flow, fraction).rate;
          }
        goal.tolerance = tolerance;
        if (fluid.converged && !last_result.agrees_within(goal))
          agree(goal);
        // On either side of a gap that stays ajar it leaks more or less.
        fluid.mesh_error = std::max(fluid.mesh_error, last_result.leak_change);
      }

      void
      agree(FeedbackGoal goal)
      {
        if (on_wall.is_limited_by_load())
          goal.largest_mean = control.target;
        double largest_pressure = std::max(std::abs(flow.fluid().inlet_pressure),
                                           std::abs(flow.fluid().outlet_pressure));
        // Reservoirs without pressure give none to compare that of trapped fluid with.
        if (largest_pressure == 0.)
          largest_pressure = scene.contact.loads() ? std::abs(control.target)
                             : near != nullptr     ? std::abs(near->nominal_pressure)
                                                   : 0.;
        FluidState &fluid = *state.fluid;
        try
          {
            bool meet = true;
            for (int meetings = 0; meet && meetings <= most_tries; ++meetings)
              {
                last_result = feedback.solve(
                  [&](const SlabField &assumed) { return round(assumed, goal.verdict); },
                  largest_pressure,
                  goal);
                meet = on_wall.settle(*state.contact, fluid_flow, feedback.pressure()) &&
                       last_result.converged;
                goal.goes_on = false;
              }
            last_result.converged = last_result.converged && !meet;
            fluid.trapped         = on_wall.trapped();
            fluid.percolates      = fluid_flow.channel.percolates();
            fluid.converged       = last_result.converged;
            fluid.load            = mean(feedback.pressure());
          }
        catch (const LiftedOff &)
          {
            lift_off();
          }
        fluid.pressure = feedback.pressure();
      }

      /** Without a fluid pressure if one @p verdict is wanted and the gap has another. */
      FeedbackRound
      round(const SlabField &assumed, const std::optional<bool> verdict)
      {
        if (on_wall.is_limited_by_load() && mean(assumed) >= control.target)
          throw LiftedOff();
        const auto start = Timers::Clock::now();
        state.contact    = contact.solve(control.target, near, &assumed);
        near             = &*state.contact;
        if (near->has_detached())
          throw LiftedOff();
        state.mean_gap = near->mean_gap;
        state.costs += {state.contact->iterations,
                        state.contact->fft_pairs,
                        1,
                        Timers::seconds_since(start)};

        FeedbackRound result;
        result.percolates =
          flow.find_channel(fluid_flow, state.contact->gap, control.slip_length);
        if (verdict && result.percolates != *verdict)
          return result;
        flow.follow(fluid_flow, mesh_accuracy / flow.fluid().target_accuracy);
        result.leak_rate      = fluid_flow.leakage.upper;
        result.fluid_pressure = on_wall.pressure(*state.contact, fluid_flow, assumed);
        log.progress(format("  feedback: fluid load %.5g, leak rate %.5g",
                            mean(result.fluid_pressure),
                            result.leak_rate));
        return result;
      }

      void
      lift_off()
      {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        ContactState    &parted   = state.contact.emplace();
        parted.pressure           = SlabField(layout);
        parted.gap                = SlabField(layout, infinite);
        parted.nominal_pressure   = control.target;
        parted.converged          = true;
        if (scene.contact.adhesion.enabled)
          parted.adhesion.emplace().detached = true; // where a path ends
        parted.mean_gap = state.mean_gap = infinite;
        // The contact that was sought until then is none of this state.
        state.costs.iterations  = 0;
        state.costs.fft_pairs   = 0;
        state.fluid->percolates = state.fluid->lifted_off = true;
        state.fluid->trapped.reset();
        state.fluid->converged = false;
        state.fluid->load      = control.target;
      }

      SealState           state;
      const Scene        &scene;
      ContactModel       &contact;
      const SlabLayoutPtr layout;
      FlowStage          &flow;
      Log                &log;
      const Control       control;
      const ContactState *near; // that the next contact starts from, if there is one
      StepFlow            fluid_flow;
      WallFeedback        feedback;
      FluidOnWall         on_wall;
      double              mesh_accuracy; // of the leak rate, on the first mesh
      FeedbackResult      last_result;
    };
  } // namespace

  SealModel
  coupled_seal(const Scene                  &scene,
               std::shared_ptr<ContactModel> contact,
               const SlabLayoutPtr          &layout,
               FlowStage                    &flow,
               Log                          &log)
  {
    return
      [&scene, contact = std::move(contact), layout, &flow, &log](const Control &control,
                                                                  const SealState *from,
                                                                  const Aim        aim) {
        flow.set_inlet_pressure(control.inlet_pressure);
        const auto reach = [&](const double fraction, const std::optional<bool> verdict) {
          Coupling coupling(scene, *contact, layout, flow, log, control, from, fraction);
          return coupling.reach(aim, verdict);
        };
        SealState state = reach(1., {});
        if (from != nullptr && changes_verdict(*from, state))
          {
            // A large step may have lost a state that is there.
            const bool verdict = from->fluid->percolates;
            SealState  kept    = reach(small_fraction, verdict);
            kept.costs += state.costs;
            if (kept.fluid->converged && kept.fluid->percolates == verdict)
              state = std::move(kept);
            else
              state.costs = kept.costs;
          }
        if (state.fluid->lifted_off && !scene.contact.adhesion.enabled)
          log.warn(
            format("the fluid alone carries a load of %.6g: the walls part and nothing "
                   "limits the leak",
                   control.target));
        return state;
      };
  }
} // namespace strait
