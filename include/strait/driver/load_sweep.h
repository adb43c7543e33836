// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_load_sweep_h
#define strait_driver_load_sweep_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/contact/contact_solver.h>
#include <strait/driver/adhesive_sweep.h>
#include <strait/driver/coupled_stage.h>
#include <strait/driver/error_budget.h>
#include <strait/driver/flow_stage.h>
#include <strait/driver/load_stops.h>
#include <strait/driver/seal_search.h>
#include <strait/driver/step.h>
#include <strait/driver/theory_prediction.h>
#include <strait/driver/threshold_search.h>

#include <functional>
#include <memory>
#include <vector>

namespace strait
{
  /**
   * The method in one place: for each load of the programme, press the surface
   * against the elastic half-space, ask whether a channel percolates through the
   * gap, and solve for the flow through it. If the scene asks for the threshold,
   * that is found first.
   */
  class LoadSweep
  {
  public:
    /** Receives each step as soon as it is done. Says whether to go on. */
    using Consumer = std::function<bool(const Step &)>;

    /** @p scene, @p log and @p timers must outlive the sweep. @p surface_energy is that
     *  of an earlier part of the run; with 0 it is the scene's, or sought. */
    LoadSweep(const Scene &scene,
              SlabField    heights,
              Log         &log,
              Timers      &timers,
              double       surface_energy = 0.);

    /** Of the adhesion; 0 without one. */
    double
    surface_energy() const
    {
      return adhesive ? adhesive->surface_energy() : 0.;
    }

    /**
     * Enclose the critical load of every slip length. The steps that follow know
     * their reduced load, and those at `Reduced loads` are added. Collective.
     */
    const std::vector<Threshold> &find_thresholds();

    /** Enclose the blow-out pressure of every load of the programme. Collective. */
    std::vector<BlowOut> find_blow_outs();

    const std::vector<Threshold> &
    known_thresholds() const
    {
      return thresholds;
    }

    /** Number of steps that run() will make. */
    int
    n_steps() const
    {
      return static_cast<int>(plan_stops(scene, thresholds).size());
    }

    /**
     * Run all steps that are not done, or those before the surfaces part under tension.
     * Collective.
     * @return whether all of them converged.
     */
    bool run(const Consumer &consume);

    /**
     * Call @p action after every solve of a search, when the state may be saved; it may
     * throw to stop. Only before the searches.
     */
    void after_probe(SealSearch::AfterProbe action);

    /** How many solves were made in searches that are not done; 0 if there is none. */
    std::size_t n_probes() const;

    /** The searches are over; what only they need is freed. */
    void end_searches();

    /** All that is to come depends on; may be called by the consumer and after a probe.
     *  Collective. */
    void transfer(StateArchive &archive);

    /** How many steps are done. */
    int
    n_done() const
    {
      return static_cast<int>(next_stop);
    }

    /** Where the state of an adhesive contact jumped, so far. */
    const std::vector<Jump> &jumps() const;

    /** Bytes that contact and bridge hold on this rank. */
    std::size_t memory_consumption() const;

  private:
    void             transfer_search(StateArchive &archive);
    bool             is_pressed(const std::vector<LoadStop> &stops) const;
    bool             press(Step &step, const LoadStop &stop);
    void             leak(Step &step);
    void             press_with_fluid(Step &step, double target);
    void             compare_with_threshold(Step &step) const;
    void             compare_with_theory(Step &step);
    const Threshold *threshold_of(double slip_length) const;

    const Scene                      &scene;
    Log                              &log;
    Timers                           &timers;
    const SlabLayoutPtr               layout;
    double                            first_guess; // of the critical load
    SlabField                         given_gap;   // if there is no contact to solve
    std::unique_ptr<ContactSolver>    contact;     // without adhesion
    std::unique_ptr<AdhesiveSweep>    adhesive;    // with it
    std::unique_ptr<FlowStage>        flow;        // unless the fluid is off
    std::unique_ptr<CoupledStage>     coupling;    // if the fluid presses on the wall
    std::unique_ptr<TheoryPrediction> theory;
    std::unique_ptr<ErrorBudget>      error_budget; // if there is a fluid
    std::unique_ptr<SealSearch>       search;       // as long as there is one to make
    std::vector<Threshold>            thresholds;
    Step                              step; // the last that was done
    std::size_t                       next_stop = 0;
    bool                              converged = true; // so far
  };
} // namespace strait

#endif
