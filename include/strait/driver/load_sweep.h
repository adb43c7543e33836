// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_load_sweep_h
#define strait_driver_load_sweep_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/contact/contact_solver.h>
#include <strait/driver/step.h>
#include <strait/interface/gap_field.h>

#include <functional>
#include <memory>

namespace strait
{
  /**
   * The method in one place: for each load of the programme, press the surface
   * against the elastic half-space, ask whether a channel percolates through the
   * gap, and solve for the flow through it.
   */
  class LoadSweep
  {
  public:
    /** Receives each step as soon as it is done. */
    using Consumer = std::function<void(const Step &)>;

    /** @p scene, @p log and @p timers must outlive the sweep. */
    LoadSweep(const Scene &scene, SlabField heights, Log &log, Timers &timers);

    /** Run all steps. Collective. @return whether all of them converged. */
    bool run(const Consumer &consume);

    /** Bytes that contact and bridge hold on this rank. */
    std::size_t memory_consumption() const;

  private:
    void      press(Step &step, double target);
    void      leak(Step &step);
    SlabField gap_seen_by_fluid(const SlabField &gap) const;
    void      report_flow(const FlowResult &flow) const;
    void      report_step(const Step &step, int n_steps) const;

    const Scene                   &scene;
    Log                           &log;
    Timers                        &timers;
    SlabField                      given_gap; // if there is no contact to solve
    std::unique_ptr<ContactSolver> contact;
    std::unique_ptr<GapField>      gap_field;
  };
} // namespace strait

#endif
