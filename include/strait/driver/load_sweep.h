// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_load_sweep_h
#define strait_driver_load_sweep_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/contact/contact_solver.h>
#include <strait/driver/error_budget.h>
#include <strait/driver/step.h>
#include <strait/driver/threshold_search.h>
#include <strait/interface/gap_field.h>

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
    /** Receives each step as soon as it is done. */
    using Consumer = std::function<void(const Step &)>;

    /** @p scene, @p log and @p timers must outlive the sweep. */
    LoadSweep(const Scene &scene, SlabField heights, Log &log, Timers &timers);

    /**
     * Enclose the critical load of every slip length. The steps that follow know
     * their reduced load, and those at `Reduced loads` are added. Collective.
     */
    const std::vector<Threshold> &find_thresholds();

    /** Number of steps that run() will make. */
    int
    n_steps() const
    {
      return static_cast<int>(plan().size());
    }

    /** Run all steps. Collective. @return whether all of them converged. */
    bool run(const Consumer &consume);

    /** Bytes that contact and bridge hold on this rank. */
    std::size_t memory_consumption() const;

  private:
    /** One step to come. */
    struct Stop
    {
      double target; // nominal pressure or mean gap
      double slip_length;
    };

    std::vector<Stop> plan() const;
    ThresholdProbe    probe(double load);
    void              press(Step &step, double target);
    void              leak(Step &step);
    void              compare_with_threshold(Step &step) const;
    SlabField         gap_seen_by_fluid(const Step &step) const;
    const Threshold  *threshold_of(double slip_length) const;

    const Scene                   &scene;
    Log                           &log;
    Timers                        &timers;
    double                         first_guess; // of the critical load
    SlabField                      given_gap;   // if there is no contact to solve
    std::unique_ptr<ContactSolver> contact;
    std::unique_ptr<GapField>      gap_field;
    std::unique_ptr<ErrorBudget>   error_budget; // if there is a fluid
    std::vector<Threshold>         thresholds;
  };
} // namespace strait

#endif
