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
  /** A matrix of the unknowns, which the ranks share. */
  using UnknownsMatrix = dealii::TrilinosWrappers::SparseMatrix;

  /** A vector of them. */
  using UnknownsVector = dealii::TrilinosWrappers::MPI::Vector;

  /**
   * One algebraic multigrid cycle, as an approximate inverse of the symmetric positive
   * definite @p matrix, whose rows are dealt out in contiguous blocks ascending with the
   * rank: of hypre's BoomerAMG, or of Trilinos' ML, smoothed aggregation. Collective.
   */
  std::unique_ptr<dealii::TrilinosWrappers::PreconditionBase>
  make_multigrid(FlowPreconditioner kind, const UnknownsMatrix &matrix);

  /** How a linear system was solved. */
  struct LinearSolve
  {
    unsigned int iterations   = 0;
    double       error_energy = 0.; // r·M⁻¹r at the end of one run of the solver
    bool         converged    = false;
  };

  /**
   * Preconditioned conjugate gradients for A x = b from the start value in @p x and its
   * residual @p r = b − A x, which is brought up to date with it, until r·M⁻¹r <= @p
   * goal.
   *
   * That is the energy of the error, as far as the preconditioner M⁻¹ resembles A⁻¹,
   * hence the error of a dissipated power. The residual itself says little: across a
   * constriction the conductivity changes by many orders of magnitude, and the rows that
   * decide about the leak rate are the smallest of all. Collective.
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
    // Written such that NaN is no success, nor is a negative one, by which rounding tells
    // that the coefficients differ too much.
    result.converged = std::abs(result.error_energy) <= goal;
    return result;
  }
} // namespace strait
