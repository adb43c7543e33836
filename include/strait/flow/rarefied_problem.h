// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_rarefied_problem_h
#define strait_flow_rarefied_problem_h

#include <strait/flow/hierarchical_correction.h>
#include <strait/flow/leakage.h>
#include <strait/percolation/channel.h>

namespace strait
{
  /**
   * Solve for the pressure of the gas of @p gap on a mesh, and for the weights of its
   * conductivity, which @p pressure then has: in turn, until the weights change the
   * energy by less than the relative @p tolerance. Collective.
   */
  LinearSolve solve_rarefied(PotentialProblem     &pressure,
                             const GapField       &gap,
                             const LinearAccuracy &accuracy,
                             double                tolerance);

  /** Replace the bounds of @p leakage, which are for the weights that were found, by
   *  those of the nonlinear problem of the gas of @p gap (RarefiedFlow), from linear
   *  problems on @p mesh, and tell the Knudsen number in the throat of @p path; with
   *  @p correction, set up for that mesh, unless that is null. Collective. */
  void bound_rarefied(FlowMesh               &mesh,
                      const GapField         &gap,
                      const FlowPath         &path,
                      const LinearAccuracy   &accuracy,
                      HierarchicalCorrection *correction,
                      Leakage                &leakage);
} // namespace strait

#endif
