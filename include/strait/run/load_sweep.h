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
    bool   is_reduced  = false; // the target is that far from the critical load
    bool   begins_anew = false; // a contact that remembers begins a new path here

    /** "loading" or "unloading": what the scene says, but where the path matters or turns
     *  the direction of the last change up to here. */
    std::string branch = {};
  };

  /** The steps of @p scene in their order: the Pressures, back again in a cycle, each
   *  with all slip lengths; and the Reduced loads of each of the @p thresholds. */
  std::vector<LoadStop> plan_stops(const Scene                   &scene,
                                   const std::vector<Transition> &thresholds);

  /** How a seal goes from stop to stop: to each from the one before or, where a path
   * begins near the critical load, from where the search for that ended. */
  class SealPath
  {
  public:
    /** @p scene must outlive the path. */
    SealPath(const Scene &scene, SealModel model);

    const SealModel model;

    /** Take the state from @p search, which is over, if that is where the path begins. */
    void begin_after(SealSearch &search);

    /** Follow the path to @p stop from @p last, the state at the stop before, if there is
     *  one. Companions on fewer points have a @p control of their own there. Collective.
     */
    Arrival go_on(const LoadStop          &stop,
                  const Control           &control,
                  std::optional<SealState> last,
                  Aim                      aim);

    /** Where it begins, if that is needed yet. Collective. */
    void transfer(StateArchive &archive, const SlabLayoutPtr &layout);

  private:
    bool begins_where_search_ended() const;

    const Scene             &scene;
    std::optional<SealState> start;
  };

  /** The channel and the leak rate in the gap of @p state, to the accuracy that @p scene
   *  asks for. Collective. */
  StepFlow leak_through(const SealState &state, const Scene &scene, FlowStage &flow);

  /** The gap of two equal boxes, one behind the other in x, for what doc/seal.md makes of
   *  the flow through them. */
  SlabField two_in_a_row(const SlabField &gap);

  /** With how many coarser grids each step of @p scene is compared. */
  int n_compared_grids(const Scene &scene);

  /** The seal of a scene on every second point of its contact grid, on every fourth, and
   *  so on. Two things are cheap there: a first idea of the critical load, which that of
   *  the grid itself is close to, and what the grid changes of a leak rate. Where the
   * past of a contact, or a fluid on its walls, matters, each goes the whole way by
   * itself. */
  class CoarserSeals
  {
  public:
    /** By what a change from every second point is multiplied where no third grid tells
     *  its order, which is then taken to be the first: the factor of safety of the grid
     *  convergence index (Roache, J. Fluids Eng. 116, 1994). With two of it a
     *  finer grid's leak rate was off by more in three of 54 cases, with four in none. */
    static constexpr double safety_factor = 3.;

    /** None where there is no fluid. @p heights on the grid of the contact, which
     *  @p contact describes. @p scene and @p log must outlive this object. Collective. */
    CoarserSeals(const Scene             &scene,
                 const ContactParameters &contact,
                 const SlabField         &heights,
                 Log                     &log);

    int
    size() const
    {
      return static_cast<int>(seals.size());
    }

    /** Find the critical loads of all of them, of the coarsest from @p first on. Returns
     *  where that of the grid itself is sought. Collective. */
    SearchStart find_critical_loads(SearchStart first);

    /** Add to the error of @p critical_load, which its throat has told, what coarser
     *  points tell where a path or windows matter; elsewhere that takes its place where
     *  the throat on every second point was off by more than an estimate may be. */
    void find_error_of(Transition &critical_load) const;

    /** Find those of the pressures of @p blow_outs. Collective. */
    void find_errors_of(std::vector<BlowOut> &blow_outs);

    /** Follow the path to @p stop, where a path matters; a load that is named by its
     * distance from the critical one, @p counted_from, is as far from that of their own
     * points. Collective. */
    void go_on(const LoadStop &stop, const Transition *counted_from);

    /** The gap on every 2^halvings-th point [length] at @p control or, with
     *  @p reduced_load, which is 1 − L/L_c, as far from the critical load of those
     *  points; where a path matters, where that has led to. None if it is not known.
     *  Collective. */
    std::optional<SlabField>
    gap(int halvings, Control control, const std::optional<double> &reduced_load);

    /** Keep only those that steps are compared with. */
    void end_searches();

    /** What is known of them, critical loads and last states. Collective. */
    void transfer(StateArchive &archive);

  private:
    struct CoarserSeal
    {
      SlabLayoutPtr              layout;
      std::unique_ptr<FlowStage> flow; // if the fluid presses on the walls
      SealPath                   path;
      std::vector<Transition>    thresholds; // once they were sought
      std::optional<SealState>   state;      // that the next is reached from
    };

    CoarserSeal make(const ContactParameters &contact, const SlabField &heights);

    /** What @p find, a function of a search, finds on the points of @p seal; nothing
     * where these do not open or close. */
    template <typename Find>
    auto search(const CoarserSeal &seal, const Find &find);

    const Scene             &scene;
    Log                     &log;
    Log                      progress_only;
    Timers                   timers; // of what is not told
    std::vector<CoarserSeal> seals;  // every second point first
  };

  /**
   * What each stage of the method adds to the uncertainty of the leak rate of a step that
   * leaks, and the parameter that would reduce it, as doc/numerics.md lists them. Where
   * its load was named by the distance from the critical load @p counted_from, or null,
   * the leak rate at that distance is what is sought, and a coarser grid is compared at
   * the same distance from its own: most of what a grid does is to shift both.
   * @p rms_height is that of the surface. Collective.
   */
  StepErrors assess_errors(const Step       &step,
                           const Transition *counted_from,
                           const Scene      &scene,
                           double            rms_height,
                           const FlowStage  &flow,
                           CoarserSeals     &coarser);

  /** Why the exponent of the leak rate cannot be told from a step that leaks below its
   *  @p threshold, why it is uncertain that one above it seals, or that a step
   *  contradicts it: words for the column `status`. Warns of each, with what would help,
   *  which depends on whether the scene @p zooms. */
  std::vector<std::string> doubts_near_threshold(const Step       &step,
                                                 const Transition &threshold,
                                                 bool              zooms,
                                                 Log              &log);

  /** How far a sweep has come. */
  struct SweepProgress
  {
    std::vector<Transition> thresholds;        // once they were sought
    std::vector<Jump>       jumps;             // of the state of an adhesive contact
    int                     n_done     = 0;    // steps
    int                     n_left_out = 0;    // since surfaces had parted
    bool                    converged  = true; // all steps, and of the searches

    double surface_energy = 0.; // the scene's, or what was found to match an area
  };

  /** The method in one place: for each load of the programme, press the surface against
   *  the elastic half-space, ask whether a channel percolates through the gap, and solve
   *  for the flow through it. If the scene asks for the critical load or the blow-out
   *  pressure, that is found first. */
  class LoadSweep
  {
  public:
    /** Receives each step as soon as it is done. May throw to stop. */
    using Consumer = std::function<void(const Step &)>;

    /** @p scene, @p log and @p timers must outlive the sweep. @p surface_energy is that
     *  of an earlier part of the run; with 0 it is the scene's, or sought. Collective. */
    LoadSweep(const Scene &scene,
              SlabField    heights,
              Log         &log,
              Timers      &timers,
              double       surface_energy = 0.);

    /** Enclose the critical load of every slip length. The steps that follow know their
     *  reduced load, and those at `Reduced loads` are added. Collective. */
    const std::vector<Transition> &find_thresholds();

    /** Enclose the blow-out pressure of every load of the programme. Collective. */
    std::vector<BlowOut> find_blow_outs();

    const SweepProgress &
    progress() const
    {
      return done;
    }

    /** Number of steps that run() will make. */
    int
    n_steps() const
    {
      return static_cast<int>(plan_stops(scene, done.thresholds).size()) -
             done.n_left_out;
    }

    /**
     * Run all steps that are not done, on each path those before the surfaces part.
     * Collective.
     * @return whether all of them converged.
     */
    bool run(const Consumer &consume);

    /** What looks for the transitions; null once the searches are over, or if there is
     *  none to make. */
    SealSearch *
    search() const
    {
      return seal_search.get();
    }

    /** The searches are over; what only they need is freed. */
    void end_searches();

    /** All that is to come depends on: the last state, the answers of a search that is
     *  not over, and what was found. May be called by the consumer and after a probe.
     *  Collective. */
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
