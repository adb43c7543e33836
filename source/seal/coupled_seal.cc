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
    // Fraction of a round's change that is taken in order to keep a state. With three
    // times of it, more states that exist are lost; half of it takes more rounds.
    constexpr double small_fraction = .1;

    // States tried as the mesh changes, and times that regions may meet in one. Half of
    // it gives up long steps on which regions meet one by one; double of it goes on
    // without end where they meet and part, or the leak rate changes with the mesh.
    constexpr int most_tries = 4;

    struct LiftedOff
    {
    };

    /** The iteration to one state, taking a fraction of the changes of relaxation. */
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
        // Fluid of another load must not lift the walls off before this one is tried.
        const double fluid_load = mean(feedback.pressure());
        if (on_wall.is_limited_by_load() && fluid_load >= control.target)
          for (double &pressure : feedback.pressure())
            pressure *= FluidOnWall::largest_fraction * control.target / fluid_load;
      }

      /** Bring contact and flow to agree as far as @p aim needs; see FeedbackGoal if only
       *  one @p verdict is wanted. */
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
      /** Bring contact and flow to agree to the accuracy of a verdict; only roughly, on a
       *  coarse mesh, if the channel is open and @p open_is_enough. */
      void
      settle(const bool open_is_enough, const std::optional<bool> verdict)
      {
        // Least tolerance of a verdict, which should not depend on what the iteration
        // leaves over; below this, what contact and flow leave over counts more. Half of
        // it takes a few rounds more; double of it blurs the tightest thresholds that can
        // be asked for.
        constexpr double least = 1e-5;
        const double     fraction =
          intermediate_tolerance_factor * scene.programme.threshold_tolerance;
        FeedbackGoal goal{std::min(scene.fluid.feedback.tolerance,
                                   std::max(fraction, least)),
                          std::numeric_limits<double>::infinity()};
        goal.once_open = open_is_enough ? intermediate_tolerance_factor : 0.;
        goal.verdict   = verdict;
        // A search for the re-sealing pressure goes on from the state that has opened.
        if (open_is_enough && !scene.programme.find_resealing)
          mesh_accuracy = std::max(mesh_accuracy, intermediate_tolerance_factor);
        agree(goal);
      }

      /**
       * Bring contact and flow close to each other on finer and finer meshes, until the
       * leak rate no longer depends on the mesh on which the fluid's pressure on the wall
       * is found; then let them agree.
       */
      void
      find_mesh()
      {
        // Refinements for one state. Half as many may leave a leak rate that changes with
        // the mesh, which the bracket then shows; twice as many cost more for gaps that
        // no mesh settles.
        constexpr int max_finer = 2;
        // Change of the leak rate beyond which contact and flow have gone to another
        // state, for which another mesh of this fraction is wanted.
        constexpr double another_state = 1. - 1. / FlowStage::remesh_ratio;

        const double target_accuracy = flow.fluid().target_accuracy;
        const double tolerance       = scene.fluid.feedback.tolerance;
        FluidState  &fluid           = *state.fluid;
        const double loosely =
          std::max(tolerance, intermediate_tolerance_factor * target_accuracy);
        FeedbackGoal goal{loosely, loosely};
        double       fraction = mesh_fraction;

        std::optional<double> leak_before;
        for (int finer = 0, states = 1;;)
          {
            agree(goal);
            goal.continues = true;
            if (fluid.lifted_off)
              return;
            if (!fluid.converged || !fluid_flow.solution)
              break;
            bool stays = true;
            if (leak_before)
              {
                // A change below half of the bracket's width, or below what the iteration
                // leaves over, is not significant.
                const Leakage &now = flow.certify(fluid_flow, fraction);
                fluid.mesh_error   = std::max({std::abs(*leak_before / now.rate - 1.),
                                               .5 * now.relative_width(),
                                               loosely});
                stays              = fluid.mesh_error <= another_state;
                // The bracket in the results may be as wide as that on the first mesh.
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
        // A gap that stays ajar leaks more on one side of its place than on the other.
        fluid.mesh_error = std::max(fluid.mesh_error, last_result.leak_change);
      }

      void
      agree(FeedbackGoal goal)
      {
        if (on_wall.is_limited_by_load())
          goal.largest_mean = control.target;
        double largest_pressure = std::max(std::abs(flow.fluid().inlet_pressure),
                                           std::abs(flow.fluid().outlet_pressure));
        // Reservoirs without pressure are no measure for that of trapped fluid.
        if (largest_pressure == 0.)
          largest_pressure = scene.contact.is_load_controlled() ? std::abs(control.target)
                             : near != nullptr ? std::abs(near->nominal_pressure)
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
                goal.continues = false;
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

      /** Find the contact under the @p assumed pressure, and the fluid in its gap. The
       *  result lacks a fluid pressure if one @p verdict is wanted and the gap has the
       *  other. Throws LiftedOff if the fluid carries the load or adhesive walls part. */
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
        // The iterations until then do not belong to the contact of this state.
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
      const ContactState *near; // the next contact starts from it; may be null
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
            // A large step may have lost a state that exists.
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
