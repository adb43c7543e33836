// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_rarefied_problem_h
#define strait_flow_rarefied_problem_h

#include <strait/flow/hierarchical_correction.h>
#include <strait/flow/leakage.h>
#include <strait/percolation/channel.h>

namespace strait
{
  /** How the linear problems of a mesh are to be solved. */
  struct LinearAccuracy
  {
    FlowPreconditioner preconditioner;
    double             energy; // relative error of the energy
  };

  /**
   * Solve for the pressure of the gas of @p gap on a mesh, and for the weights of its
   * conductivity, which @p pressure then has: in turn, until the weights change the
   * energy by less than the relative @p tolerance. @p starts_from_solution says whether
   * @p pressure has a solution, of this mesh or the one before. Collective.
   */
  LinearSolve solve_rarefied(PotentialProblem     &pressure,
                             const GapField       &gap,
                             const LinearAccuracy &accuracy,
                             double                tolerance,
                             bool                  starts_from_solution);

  /** Replace the bounds of @p leakage by those of the nonlinear problem of the gas of
   *  @p gap (RarefiedFlow), from linear problems on @p mesh; with @p correction, set up
   *  for that mesh, unless that is null. Collective. */
  void bound_rarefied(FlowMesh               &mesh,
                      const GapField         &gap,
                      const LinearAccuracy   &accuracy,
                      HierarchicalCorrection *correction,
                      Leakage                &leakage);

  /** Mean free path over gap of the gas of @p gap in the throat of @p path, at the
   * pressure that the path's resistances give. */
  double knudsen_number(const FlowPath &path, const RarefiedFlow &gas);
} // namespace strait

#endif
