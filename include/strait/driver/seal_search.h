// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_seal_search_h
#define strait_driver_seal_search_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/contact/contact_solver.h>
#include <strait/driver/adhesive_sweep.h>
#include <strait/driver/blow_out.h>
#include <strait/driver/coupled_stage.h>
#include <strait/driver/search_record.h>
#include <strait/driver/threshold_search.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * Finds where a seal begins or ceases to leak: the critical loads, and the inlet
   * pressures that blow it out. It can be stopped after any probe and go on later.
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

    /** Called after every probe, when the state may be saved; may throw to stop. */
    using AfterProbe = std::function<void()>;

    /** @p scene, the stages and @p log must outlive this object. */
    SealSearch(const Scene &scene, const Stages &stages, Log &log);

    /** From now on. */
    void
    after_probe(AfterProbe action)
    {
      look_up = std::move(action);
    }

    /** The critical load of every slip length. Collective. */
    std::vector<Threshold> find_thresholds(double first_guess);

    /** The blow-out pressure of every load of the programme. Collective. */
    std::vector<BlowOut> find_blow_outs();

    /** What was found so far, without what the stages hold. Collective. */
    void transfer(StateArchive &archive);

    /** How many contact solves, or solves of contact and flow, were made. */
    std::size_t
    n_probes() const
    {
      return loads.size() + pressures.size();
    }

  private:
    ThresholdProbe probe_load(double load, double slip_length);
    ThresholdProbe probe(double load, double slip_length);
    ContactState   state_under(double load, double slip_length);
    ContactState   state_with_fluid(double load, double slip_length);
    BlowOut        blow_out(double load);
    Resealing      resealing(BlowOut &found);
    BlowOutProbe
    probe_pressure(double load, double pressure_difference, const SlabField &start);
    BlowOutProbe
         pressurise(double load, double pressure_difference, const SlabField &start);
    bool is_loading() const;
    void keep_fluid(bool leaks);
    void warn_of_disagreement(const Step &step, double load) const;
    void report(const Threshold &found) const;

    const Scene &scene;
    const Stages stages;
    Log         &log;
    AfterProbe   look_up = []() {};

    // With coupling: the fluid's pressure in the last probes that leaked and did not,
    // from which the next ones start.
    SlabField open_fluid, held_fluid;

    SearchRecord<ThresholdProbe> loads;
    SearchRecord<BlowOutProbe>   pressures;
  };
} // namespace strait

#endif
