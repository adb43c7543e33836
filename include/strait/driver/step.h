// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_step_h
#define strait_driver_step_h

#include <strait/contact/contact_state.h>
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

    /** Mesh and pressure; none where nothing percolates. Valid until the next
     *  step changes the gap. */
    std::unique_ptr<const ReynoldsSolver> solver;
  };

  /** One step of the load programme, with all that its output may need. */
  struct Step
  {
    int                         number = 0;    // counts from 1
    SlabField                   gap;           // a given one is below zero where closed
    double                      mean_gap = 0.; // closed points count as zero
    std::optional<ContactState> contact;       // unless the gap was given
    std::optional<StepFlow>     flow;          // unless the fluid is off
    double                      contact_seconds = 0.;
    double                      flow_seconds    = 0.;

    /** "ok", or a short word for the first thing that failed. */
    std::string
    status() const
    {
      if (contact && !contact->converged)
        return "contact-not-converged";
      return flow ? flow->result.status : "ok";
    }
  };
} // namespace strait

#endif
