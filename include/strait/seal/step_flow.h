// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_step_flow_h
#define strait_seal_step_flow_h

#include <strait/flow/constrictions.h>
#include <strait/flow/leakage.h>
#include <strait/percolation/channel.h>

#include <memory>
#include <optional>

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
} // namespace strait

#endif
