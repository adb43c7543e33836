// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/timers.h>
#include <strait/run/step.h>
#include <strait/run/theory_prediction.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/path.h>
#include <strait/seal/seal_search.h>
#include <strait/surface/statistics.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** One step to come. */
  struct LoadStop
  {
    double target; // nominal pressure or mean gap
    double slip_length;
    bool   is_reduced      = false; // the target comes from a reduced load
    bool   starts_new_path = false; // a new path begins here
    bool   goes_further    = true;  // than all before it on its path, or as far
    double largest_on_path = 0.;    // largest magnitude of the targets of its path

    /** "loading" or "unloading", as the scene says; in a cycle, or if the state depends
     *  on its past, the direction of the last change of the target. */
    std::string branch = {};
  };

  /** Return the steps of @p scene in their order: first the Pressures, in a cycle there
   *  and back, each with all slip lengths; then the Reduced loads of each critical load
   *  in @p thresholds, sorted in the direction of the path. */
  std::vector<LoadStop> plan_stops(const Scene                   &scene,
                                   const std::vector<Transition> &thresholds);

  /** Leads a seal from stop to stop. Each stop is reached from the one before or, where a
   *  path begins near the critical load, from the state in which the search ended. */
  class SealPath
  {
  public:
    /** @p scene must outlive the path. */
    SealPath(const Scene &scene, SealModel model);

    const SealModel model;

    /** Take over the state of @p search, which is over, if the path begins there. */
    void begin_after(SealSearch &search);

    /** Follow the path to @p stop from @p last, the state at the stop before, if there is
     *  one. @p control is that of the stop; coarser grids may have another target there.
     *  Collective. */
    Arrival advance_to(const LoadStop          &stop,
                       const Control           &control,
                       std::optional<SealState> last,
                       Aim                      aim);

    /** Save or restore the state where the path begins, if still needed. Collective. */
    void transfer(StateArchive &archive, const SlabLayoutPtr &layout);

  private:
    bool begins_where_search_ended() const;

    const Scene             &scene;
    std::optional<SealState> start;
  };

  /** Find the channel in the gap of @p state and its leak rate, to the accuracy that
   *  @p scene asks for. Collective. */
  StepFlow leak_through(const SealState &state, const Scene &scene, FlowStage &flow);

  /** Return the gap of two equal boxes, one behind the other in x. doc/seal.md explains
   *  what the flow through them is needed for. */
  SlabField two_in_a_row(const SlabField &gap);

  /** Return the number of coarser grids with which each step of @p scene is compared. */
  int n_compared_grids(const Scene &scene);

  /** Warn if @p scene wants the error of a contact @p grid that has no coarser one. */
  void warn_of_unknown_grid_error(const Scene &scene, const PeriodicGrid &grid, Log &log);

  /** The seal of a scene on every second point of its contact grid, on every fourth, and
   *  so on. At low cost these coarser grids give a first estimate of the critical load of
   *  the grid itself, and tell how a leak rate changes with the grid. If the state
   *  depends on its past, or a fluid presses on the walls, each of them follows the whole
   *  path by itself. */
  class CoarserSeals
  {
  public:
    /** Factor on the change from every second point if no third grid tells the order of
     *  convergence, which is then taken to be one: the factor of safety of the grid
     *  convergence index (Roache, J. Fluids Eng. 116, 1994). With a factor of two, the
     *  leak rate of a finer grid was off by more in three of 54 cases, with four in
     *  none. */
    static constexpr double safety_factor = 3.;

    /** Make the coarser seals that @p scene needs; none without a fluid. @p heights are
     *  those on the contact grid, and @p contact the completed section. @p scene and
     *  @p log must outlive this object. Collective. */
    CoarserSeals(const Scene             &scene,
                 const ContactParameters &contact,
                 const SlabField         &heights,
                 Log                     &log);

    int
    size() const
    {
      return static_cast<int>(seals.size());
    }

    /** Find the critical loads on all coarser grids, beginning with the coarsest, whose
     *  search starts at @p first. Return the start for the search on the grid itself.
     *  Collective. */
    SearchStart find_critical_loads(SearchStart first);

    /** Complete the grid error of @p critical_load, so far an estimate from its throat.
     *  If the path or windows matter, add what the coarser grids change. Otherwise, if
     *  the change from every second point exceeds safety_factor times the estimate from
     *  the throat there, raise it to safety_factor times that change. */
    void complete_grid_error(Transition &critical_load) const;

    /** Find the grid errors of the pressures in @p blow_outs, if the scene asks for an
     *  error budget. Collective. */
    void estimate_grid_errors(std::vector<BlowOut> &blow_outs);

    /** Follow the path to @p stop on all coarser grids, for scenes whose states depend on
     *  the path. A target from a reduced load keeps its distance from the critical load:
     *  that of the grid itself is @p reference_critical_load, those of the coarser grids
     * are their own. Collective. */
    void advance_to(const LoadStop &stop, const Transition *reference_critical_load);

    /** Return the gap on every 2^halvings-th point [length] at @p control or, with
     *  @p reduced_load, 1 − L/L_c, as far from the critical load of that grid. If the
     *  path matters, return the gap that advance_to() has led to, or none if that is not
     *  known. Collective. */
    std::optional<SlabField>
    gap(int halvings, Control control, const std::optional<double> &reduced_load);

    /** Keep only the grids that steps are compared with. */
    void end_searches();

    /** Save or restore the critical loads and the last states. Collective. */
    void transfer(StateArchive &archive);

  private:
    struct CoarserSeal
    {
      SlabLayoutPtr              layout;
      std::unique_ptr<FlowStage> flow; // if the fluid presses on the walls
      SealPath                   path;
      std::vector<Transition>    thresholds; // empty until they are found
      std::optional<SealState>   state;      // from which the next one is reached
    };

    CoarserSeal make(const ContactParameters &contact, const SlabField &heights);

    /** Return what @p find returns for a search on the grid of @p seal. If that throws
     *  ComputationError, warn and return an empty result. */
    template <typename Find>
    auto search(const CoarserSeal &seal, const Find &find);

    const Scene             &scene;
    Log                     &log;
    Log                      progress_only;
    Timers                   timers; // not reported
    std::vector<CoarserSeal> seals;  // the first on every second point
  };

  /**
   * Estimate what each stage of the method adds to the error of the leak rate of a step
   * that leaks, with the parameter that would reduce it; doc/numerics.md lists the
   * stages. If the scene gives the load as a reduced one, @p reference_critical_load is
   * the critical load, otherwise null. A coarser grid is then compared at the same
   * reduced load, because a grid mostly shifts the critical load, and the leak rate with
   * it.
   * @p rms_height is that of the surface. Collective.
   */
  StepErrors assess_errors(const Step       &step,
                           const Transition *reference_critical_load,
                           const Scene      &scene,
                           double            rms_height,
                           const FlowStage  &flow,
                           CoarserSeals     &coarser);

  /** Return the doubts about a step, as words for the column `status`: it contradicts its
   *  @p threshold; it leaks below it, but the critical load or the throat is not known
   *  well enough for the exponent of the leak rate; or it seals so little above it that
   *  finer points may leak. Warn of each with a remedy, which depends on whether the
   *  scene @p zooms. */
  std::vector<std::string> doubts_near_threshold(const Step       &step,
                                                 const Transition &threshold,
                                                 bool              zooms,
                                                 Log              &log);

  /** How far a sweep has come. */
  struct SweepProgress
  {
    std::vector<Transition> thresholds;        // empty until they are found
    std::vector<Jump>       jumps;             // of the state of an adhesive contact
    int                     n_done     = 0;    // steps
    int                     n_left_out = 0;    // steps, because the surfaces had parted
    bool                    converged  = true; // all steps and searches so far

    double surface_energy = 0.; // the scene's, or found to match a contact area
  };

  /** The method in one place: for each load of the programme, press the surface against
   *  the elastic half-space, find out whether a channel percolates through the gap, and
   *  solve for the flow through it. If the scene asks for critical loads or blow-out
   *  pressures, find_thresholds() and find_blow_outs() are called first. */
  class LoadSweep
  {
  public:
    /** Receives each step as soon as it is done. May throw to stop. */
    using Consumer = std::function<void(const Step &)>;

    /** @p scene, @p log and @p timers must outlive the sweep. @p surface_energy is the
     *  one from an earlier part of the run; if it is 0, it is taken from the scene, or
     *  found as the scene asks. Collective. */
    LoadSweep(const Scene &scene,
              SlabField    heights,
              Log         &log,
              Timers      &timers,
              double       surface_energy = 0.);

    /** Enclose the critical load of every slip length. From then on steps have a reduced
     *  load, and those at `Reduced loads` are added. Collective. */
    const std::vector<Transition> &find_thresholds();

    /** Enclose the blow-out pressure of every load of the programme and, if the scene
     *  asks for it, the re-sealing pressure. Collective. */
    std::vector<BlowOut> find_blow_outs();

    const SweepProgress &
    progress() const
    {
      return done;
    }

    /** Number of steps of the whole run, those done included. */
    int
    n_steps() const
    {
      return static_cast<int>(plan_stops(scene, done.thresholds).size()) -
             done.n_left_out;
    }

    /**
     * Run all steps that are not done; a path ends where the surfaces part. Collective.
     * @return whether all steps and searches converged.
     */
    bool run(const Consumer &consume);

    /** The search for transitions; null if the scene needs none, or once it is over. */
    SealSearch *
    search() const
    {
      return seal_search.get();
    }

    /** Free what only the searches need. */
    void end_searches();

    /** Save or restore all that the rest of the run depends on: the last state, the
     *  answers of a search that is not over, and what was found. May be called by the
     *  consumer and after a probe. Collective. */
    void transfer(StateArchive &archive);

  private:
    bool press(const LoadStop &stop);
    void leak();
    void judge(const LoadStop &stop);

    const Scene                      &scene;
    Log                              &log;
    Timers                           &timers;
    const SlabLayoutPtr               layout;
    const SurfaceStatistics           surface;
    ContactParameters                 contact;
    CoarserSeals                      coarser;
    std::unique_ptr<FlowStage>        flow; // unless the fluid is off
    std::unique_ptr<TheoryPrediction> theory;
    std::optional<SealPath>           path;
    std::unique_ptr<SealSearch>       seal_search;
    SweepProgress                     done;
    Step                              step; // the last that was done
  };
} // namespace strait
