// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_step_h
#define strait_driver_step_h

#include <strait/base/text.h>
#include <strait/contact/contact_state.h>
#include <strait/driver/theory_prediction.h>
#include <strait/flow/constrictions.h>
#include <strait/flow/leakage.h>
#include <strait/percolation/channel.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  class ReynoldsSolver;
  struct SealMesh;

  /** What the fluid does in one gap. */
  struct StepFlow
  {
    Channel channel;
    Leakage leakage; // a rate of zero where nothing percolates

    /** If the scene looks for the threshold and something percolates. */
    std::optional<ConstrictionReport> constrictions;

    /** For fields and pictures: the mesh that the scene names, null if the fluid flows in
     *  the box, and the mesh and pressure of the flow, null where nothing percolates;
     *  valid until the flow stage is given another gap. */
    const SealMesh                 *seal = nullptr;
    std::shared_ptr<ReynoldsSolver> solution;
  };

  /** How contact and flow came to agree, where the fluid presses on the wall. */
  struct StepFeedback
  {
    double fluid_load         = 0.; // mean fluid pressure over the nominal area
    int    iterations         = 0;  // rounds of contact and flow
    int    contact_iterations = 0;  // of all rounds
    long   fft_pairs          = 0;  // likewise
    double mesh_error = 0; // what the last mesh changed of the leak rate, relative
    bool   converged  = false;
    bool   undecided  = false; // see FeedbackResult
    bool   lifted_off = false; // the fluid carries more than the load
  };

  /** One source of error of a leak rate. */
  struct ErrorItem
  {
    std::string source;
    double      relative = 0.;
    std::string parameter; // that would reduce it
  };

  /** The errors of a step's leak rate, the largest first (error_budget.h). */
  struct StepErrors
  {
    std::vector<ErrorItem> items;
    std::optional<double>  grid_order;   // observed from contact grid to contact grid
    std::optional<double>  extrapolated; // leak rate at a grid spacing of zero
  };

  /** One step of the load programme, with all that its output may need. */
  struct Step
  {
    int                         number = 0;    // counts from 1
    std::string                 branch;        // loading or unloading
    SlabField                   gap;           // a given one is below zero where closed
    double                      mean_gap = 0.; // closed points count as zero
    std::optional<ContactState> contact;       // unless the gap was given
    double                      dissipated_energy = 0.; // by jumps of the contact
    std::optional<StepFlow>     flow;                   // unless the fluid is off
    std::optional<StepFeedback> feedback; // if the fluid presses on the wall
    std::optional<TheoryResult> theory;   // if the scene asks for it
    double                      slip_length = 0.;
    std::optional<double>       reduced_load; // 1 − L/L_c, if the threshold is known
    StepErrors                  errors;       // of the leak rate, if there is one
    std::vector<std::string>    doubts;       // about a result that may have converged
    double                      contact_seconds = 0.;
    double                      flow_seconds    = 0.;

    /** Whether all solvers reached what was asked of them. */
    bool
    converged() const
    {
      return (!contact || contact->converged) &&
             (!flow || flow->leakage.status == "ok") &&
             (!feedback || feedback->converged);
    }

    /** "ok", or a short word for each thing that failed or is in doubt, joined by +. */
    std::string
    status() const
    {
      std::vector<std::string> words;
      if (contact && !contact->converged)
        words.emplace_back("contact-not-converged");
      if (flow && flow->leakage.status != "ok")
        words.push_back(flow->leakage.status);
      if (feedback && !feedback->converged)
        words.emplace_back(feedback->lifted_off  ? "lifted-off"
                           : feedback->undecided ? "feedback-undecided"
                                                 : "feedback-not-converged");
      words.insert(words.end(), doubts.begin(), doubts.end());
      return words.empty() ? "ok" : join(words, "+");
    }
  };
} // namespace strait

#endif
