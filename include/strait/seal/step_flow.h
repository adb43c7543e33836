// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_step_flow_h
#define strait_seal_step_flow_h

#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_path.h>
#include <strait/seal/constriction_report.h>

#include <memory>
#include <optional>
#include <vector>

namespace strait
{
  /** What the fluid does in one gap. */
  struct StepFlow
  {
    Clusters              clusters;
    std::vector<FlowPath> paths;  // empty where nothing percolates
    FlowResult            result; // zero leak rate where nothing percolates

    /** The mesh that the scene names, where the fluid flows; null: the box. */
    const SealMesh *seal         = nullptr;
    double          shape_factor = 0.; // of that mesh: Q/(K Δp) at a uniform K

    /** If the scene looks for the threshold and something percolates. */
    std::optional<ConstrictionReport> constrictions;

    /** Mesh and pressure; none where nothing percolates. Valid until the next
     *  step changes the gap. */
    std::unique_ptr<ReynoldsSolver> solver;
  };
} // namespace strait

#endif
