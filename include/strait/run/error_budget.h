// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_error_budget_h
#define strait_run_error_budget_h

#include <strait/base/json.h>
#include <strait/base/scene.h>
#include <strait/contact/contact_solver.h>
#include <strait/run/step.h>
#include <strait/seal/seal_search.h>
#include <strait/seal/zoomed_seal.h>

#include <memory>
#include <string>
#include <vector>

namespace strait
{
  /**
   * What each stage of the method adds to the uncertainty of a step's leak rate, and
   * the parameter that would reduce it.
   *
   * - mesh: half the width of the bracket;
   * - linear solver: the share of the energy at which it stops;
   * - contact tolerance: the gap is known to the residual times the rms height, the
   *   leak rate to three times that over the narrowest gap.
   *
   * With `Output/Error budget` two more contact and three more flow problems are
   * solved for each step, which about doubles its time:
   * - contact grid: the same step on every second and every fourth point. Where both
   *   leak and the differences shrink, the observed order extrapolates to a spacing
   *   of zero, and the distance to there is the error; else it is the difference;
   * - gap interpolation: bilinear in place of monotone cubic, or the reverse.
   *
   * Where the contact is solved in windows of finer points that is done in any case, but
   * for the contact grid:
   * - zoom levels: half of what it changes to take the finest window from every throat,
   *   as if the error fell with the spacing, which is divided by three;
   * - contact grid: what the same step on every second point changes, with windows of its
   *   own that resolve the throats as well. A load that was named by its distance from
   *   the critical load is as far from that of every second point: most of what a grid
   *   does is to shift both;
   * - critical load: what half of its bracket's width changes at such a load, by
   *   leak_rate_exponent.
   */
  class ErrorBudget
  {
  public:
    /** @p heights on the grid of the contact, which @p contact describes. Collective.
     *  @p scene must outlive this object. */
    ErrorBudget(const Scene             &scene,
                const ContactParameters &contact,
                const SlabField         &heights);

    /** The errors of a step that leaks, whose state @p seal has made. Where its load was
     *  named by the distance from the critical load @p counted_from, or null, the leak
     *  rate at that distance is what is sought. Collective. */
    StepErrors assess(const Step &step, SealModel &seal, const Transition *counted_from);

    /** What the next assessment begins with. Collective. */
    void transfer(StateArchive &archive);

  private:
    /** The leak rate of the step on a coarser grid; 0 if that seals. */
    double leak_on(int halvings, const Step &step);

    void add_contact_grid(const Step &step, StepErrors &errors);
    void add_zoom(const Step       &step,
                  SealModel        &seal,
                  const Transition *counted_from,
                  StepErrors       &errors);

    /** The control on the coarser grid that is that of @p step. Collective. */
    Control coarser_control(const Step &step, const Transition *counted_from);

    void add_interpolation(const Step &step, StepErrors &errors) const;

    const Scene                                &scene;
    double                                      rms_height;
    std::vector<std::unique_ptr<ContactSolver>> coarser; // N/2, N/4

    // With windows: N/2, the last state there, and the critical loads if one was needed.
    Log                         silent;
    std::unique_ptr<ZoomedSeal> coarser_zoomed;
    SlabLayoutPtr               coarser_layout;
    std::optional<SealState>    coarser_state;
    std::vector<Transition>     coarser_thresholds;
  };

  /** The errors for run.json. */
  Json to_json(const Step &step);

  /** One line for the log: the largest error, and what would reduce it. */
  std::string describe_errors(const StepErrors &errors);
} // namespace strait

#endif
