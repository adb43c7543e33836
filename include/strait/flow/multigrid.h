// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_multigrid_h
#define strait_flow_multigrid_h

#include <strait/base/fluid_parameters.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>

namespace strait
{
  /** One algebraic multigrid cycle as an approximate inverse of a matrix. */
  class Multigrid
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    virtual ~Multigrid() = default;

    /** z = M⁻¹ r. Collective. */
    virtual void apply(const Vector &r, Vector &z) = 0;
  };

  /**
   * Set up a cycle for the symmetric positive definite @p matrix, whose rows are
   * dealt out in contiguous blocks ascending with the rank.
   *
   * boomeramg: hypre's BoomerAMG with HMIS coarsening, extended+i interpolation of
   * at most 4 entries a row, threshold 0.25 and one symmetric Gauss–Seidel sweep.
   * ml: Trilinos' ML, smoothed aggregation with threshold 0.02, W-cycle, two
   * symmetric Gauss–Seidel sweeps, direct coarse solver. Collective.
   */
  std::unique_ptr<Multigrid> make_multigrid(FlowPreconditioner       kind,
                                            const Multigrid::Matrix &matrix);

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
