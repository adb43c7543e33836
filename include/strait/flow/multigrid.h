// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <cmath>
#include <memory>

namespace strait
{
  /** A matrix of the unknowns, distributed over the ranks. */
  using UnknownsMatrix = dealii::TrilinosWrappers::SparseMatrix;

  /** A vector of the unknowns, distributed likewise. */
  using UnknownsVector = dealii::TrilinosWrappers::MPI::Vector;

  /**
   * Make one cycle of algebraic multigrid, hypre's BoomerAMG or Trilinos' ML (smoothed
   * aggregation), as an approximate inverse of the symmetric positive definite @p matrix.
   * Its rows are distributed in contiguous blocks that ascend with the rank. Throws
   * ComputationError if hypre fails. Collective.
   */
  std::unique_ptr<dealii::TrilinosWrappers::PreconditionBase>
  make_multigrid(FlowPreconditioner kind, const UnknownsMatrix &matrix);

  /** The outcome of a linear solve. */
  struct LinearSolve
  {
    unsigned int iterations   = 0;
    double       error_energy = 0.; // r·M⁻¹r at the end of a single run
    bool         converged    = false;
  };

  /**
   * Solve A x = b by preconditioned conjugate gradients, from the start value in @p x and
   * its residual @p r = b − A x, until r·M⁻¹r <= @p goal. Both are updated.
   *
   * As far as the preconditioner M⁻¹ resembles A⁻¹, r·M⁻¹r is the energy of the error,
   * and hence the error of the dissipated power. The residual itself says little: across
   * a constriction the conductivity changes by many orders of magnitude, and the rows
   * that decide about the leak rate are the smallest of all. Collective.
   */
  template <class Matrix, class Vector, class Preconditioner>
  LinearSolve
  solve_by_conjugate_gradients(const Matrix      &A,
                               Vector            &x,
                               Vector            &r,
                               Preconditioner    &preconditioner,
                               const double       goal,
                               const unsigned int max_iterations)
  {
    Vector z(r), image(r);
    preconditioner.vmult(z, r);
    Vector      direction(z);
    LinearSolve result;
    result.error_energy = r * z;
    while (result.error_energy > goal && result.iterations < max_iterations)
      {
        A.vmult(image, direction);
        const double step = result.error_energy / (direction * image);
        x.add(step, direction);
        r.add(-step, image);
        preconditioner.vmult(z, r);
        const double next = r * z;
        direction.sadd(next / result.error_energy, 1., z);
        result.error_energy = next;
        ++result.iterations;
      }
    // Written so that neither NaN nor a value below −goal is a success: rounding makes it
    // negative where the coefficients differ too much.
    result.converged = std::abs(result.error_energy) <= goal;
    return result;
  }
} // namespace strait
