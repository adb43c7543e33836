// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_coupled_stage_h
#define strait_driver_coupled_stage_h

#include <strait/contact/contact_solver.h>
#include <strait/coupling/pressure_continuation.h>
#include <strait/coupling/unsettled_pools.h>
#include <strait/coupling/wall_feedback.h>
#include <strait/driver/flow_stage.h>

namespace strait
{
  /**
   * Contact and flow that agree with each other: the fluid presses the walls apart,
   * and the gap decides where the fluid goes. Exists only where the scene enables
   * Wall feedback.
   *
   * The fluid's pressure is that of the flow in the channel, that of the reservoir in
   * regions that only one of them reaches, the pool pressure in those that none does
   * (but see UnsettledPools), and continued under the contact. Contact is then the dry
   * problem for the wall that this pressure has displaced, under the load that it leaves
   * (Step::contact holds the pressure of the solid beyond the fluid's).
   */
  class CoupledStage
  {
  public:
    /** The contact and the flow must outlive this object. */
    CoupledStage(const Scene &scene, ContactSolver &contact, FlowStage &flow, Log &log);

    /**
     * Fill in contact, gap, flow and feedback of @p step at the load (or mean gap)
     * @p target, starting from the fluid pressure that is there. Contact and flow agree
     * on finer and finer meshes, until the bracket of the leak rate, with the change that
     * the last mesh made, is as narrow as asked. Collective.
     */
    void solve(Step &step, double target);

    /** The same to the accuracy of a verdict, without the leak rate. Collective. */
    void settle(Step &step, double target);

    /** The pressure of the fluid on the grid [pressure]. */
    SlabField &
    fluid_pressure()
    {
      return feedback.pressure();
    }

    /** What the next solve starts from. Collective. */
    void transfer(StateArchive &archive);

    /** Bytes on this rank. */
    std::size_t
    memory_consumption() const
    {
      return feedback.memory_consumption() + continuation.memory_consumption() +
             pools.memory_consumption();
    }

  private:
    struct LiftedOff
    {
    };

    void          iterate(Step &step, double target, FeedbackGoal goal);
    double        find_mesh(Step &step, double target, FeedbackGoal &goal);
    void          allow_for_mesh(Step &step) const;
    void          begin(double target);
    double        largest_pressure() const;
    FeedbackRound round(Step &step, double target, const SlabField &assumed);
    SlabField     pressure_in(const Step &step, SlabField start);
    void          lift_off(Step &step, double target) const;

    const Scene         &scene;
    ContactSolver       &contact;
    FlowStage           &flow;
    Log                 &log;
    WallFeedback         feedback;
    PressureContinuation continuation;
    UnsettledPools       pools;
    FeedbackResult       last_result;
    bool                 has_continued = false; // so that its result is a start
  };
} // namespace strait

#endif
