// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_linear_solver_h
#define strait_flow_linear_solver_h

#include <strait/flow/multigrid.h>

namespace strait
{
  /** How a linear system was solved. */
  struct LinearSolve
  {
    unsigned int iterations   = 0;
    double       error_energy = 0.; // r·M⁻¹r at the end
    bool         converged    = false;
  };

  /**
   * Preconditioned conjugate gradients for A x = b from the start value in @p x,
   * until r·M⁻¹r <= @p goal with the residual r = b − A x.
   *
   * That is the energy of the error, as far as the multigrid cycle M⁻¹ resembles
   * A⁻¹, hence the error of a dissipated power. The residual itself says little:
   * across a constriction the conductivity changes by many orders of magnitude, and
   * the rows that decide about the leak rate are the smallest of all. Collective.
   */
  LinearSolve solve_by_conjugate_gradients(const Multigrid::Matrix &A,
                                           Multigrid::Vector       &x,
                                           const Multigrid::Vector &b,
                                           Multigrid               &multigrid,
                                           double                   goal,
                                           unsigned int             max_iterations);
} // namespace strait

#endif
