// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_step_h
#define strait_driver_step_h

#include <strait/contact/contact_state.h>
#include <strait/driver/constriction_report.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_path.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** What the fluid does in one gap. */
  struct StepFlow
  {
    Clusters              clusters;
    std::vector<FlowPath> paths;  // empty where nothing percolates
    FlowResult            result; // zero leak rate where nothing percolates

    /** If the scene looks for the threshold and something percolates. */
    std::optional<ConstrictionReport> constrictions;

    /** Mesh and pressure; none where nothing percolates. Valid until the next
     *  step changes the gap. */
    std::unique_ptr<const ReynoldsSolver> solver;
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
    SlabField                   gap;           // a given one is below zero where closed
    double                      mean_gap = 0.; // closed points count as zero
    std::optional<ContactState> contact;       // unless the gap was given
    std::optional<StepFlow>     flow;          // unless the fluid is off
    double                      slip_length = 0.;
    std::optional<double>       reduced_load; // 1 − L/L_c, if the threshold is known
    std::string                 remark;       // a doubt about a converged result
    StepErrors                  errors;       // of the leak rate, if there is one
    double                      contact_seconds = 0.;
    double                      flow_seconds    = 0.;

    /** Whether all solvers reached what was asked of them. */
    bool
    converged() const
    {
      return (!contact || contact->converged) && (!flow || flow->result.status == "ok");
    }

    /** "ok", or a short word for the first thing that failed or is in doubt. */
    std::string
    status() const
    {
      if (contact && !contact->converged)
        return "contact-not-converged";
      if (flow && flow->result.status != "ok")
        return flow->result.status;
      return remark.empty() ? "ok" : remark;
    }
  };
} // namespace strait

#endif
