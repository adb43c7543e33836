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
} // namespace strait

#endif
