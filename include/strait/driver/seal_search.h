// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_seal_search_h
#define strait_driver_seal_search_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/contact/contact_solver.h>
#include <strait/driver/adhesive_sweep.h>
#include <strait/driver/blow_out.h>
#include <strait/driver/coupled_stage.h>
#include <strait/driver/threshold_search.h>

#include <vector>

namespace strait
{
  /**
   * Finds where a seal begins or ceases to leak: the critical loads, and the inlet
   * pressures that blow it out.
   */
  class SealSearch
  {
  public:
    /** What there is of a sweep; the others are null. */
    struct Stages
    {
      ContactSolver *contact;  // without adhesion
      AdhesiveSweep *adhesive; // with it
      FlowStage     *flow;
      CoupledStage  *coupling; // if the fluid presses on the wall
    };

    /** @p scene, the stages and @p log must outlive this object. */
    SealSearch(const Scene &scene, const Stages &stages, Log &log);

    /** The critical load of every slip length. Collective. */
    std::vector<Threshold> find_thresholds(double first_guess);

    /** The blow-out pressure of every load of the programme. Collective. */
    std::vector<BlowOut> find_blow_outs();

  private:
    ThresholdProbe probe(double load, double slip_length);
    ContactState   state_under(double load, double slip_length);
    ContactState   state_with_fluid(double load, double slip_length);
    BlowOut        blow_out(double load);
    Resealing      resealing(BlowOut &found);
    BlowOutProbe   pressurise(double load, double pressure_difference);
    void           report(const Threshold &found) const;

    const Scene &scene;
    const Stages stages;
    Log         &log;
    SlabField    start;      // fluid pressure that each probe begins with, with coupling
    SlabField    open_fluid; // of the last probe that leaked
  };
} // namespace strait

#endif
