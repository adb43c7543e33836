// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/flow_mesh.h>
#include <strait/flow/multigrid.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace strait
{
  /** The coefficient c of a potential problem on the owned cells of a mesh, in the order
   *  of iteration, without weights. */
  struct CellCoefficient
  {
    std::vector<double> means; // over each cell; of K, zero where nothing flows

    /** The lower halves of A_ij = ∫ c ∇φ_i·∇φ_j, cell after cell, row by row. */
    std::vector<double> entries;

    /** Set @p matrix to A of @p cell. */
    void stiffness(std::size_t cell, dealii::FullMatrix<double> &matrix) const;
  };

  /**
   * Return the coefficient that follows from @p gap on the cells of @p mesh. In the box
   * it is exact, and the gap may be on the grid of the mesh or on one with half, a
   * quarter … of its points each way; on a seal mesh it is integrated by quadrature. The
   * potentials are those of @p fe: FE_Q of degree @p degree, or FE_Q_iso_Q1(2) with a
   * degree of 1, bilinear on the four children of a cell. Collective.
   */
  CellCoefficient coefficient_on_cells(const FlowMesh                 &mesh,
                                       unsigned int                    degree,
                                       const dealii::FiniteElement<2> &fe,
                                       GapField::Coefficient           kind,
                                       const GapField                 &gap);

  /** How a linear system is to be solved. */
  struct LinearAccuracy
  {
    FlowPreconditioner preconditioner;
    double             energy; // relative error of the energy
  };

  /**
   * One of the two variational problems that enclose the leak rate, on the current
   * mesh:
   * - pressure, with the conductivity K: p = 1 at the inlet and 0 at the outlet; it
   *   minimises ∫ K |∇p|², whose minimum is Q/Δp;
   * - stream function, with the resistivity 1/K: ψ = ±(coordinate across)/(length across)
   *   + a periodic part, free at the reservoirs; its curl is a divergence-free flux of
   *   total 1, and it minimises ∫ |∇ψ|²/K, whose minimum is Δp/Q. On a strip ψ is 0 at
   *   the right and 1 at the left wall; around a ring it is ±(angle)/2π + a
   *   single-valued function.
   * Both are conforming, so each energy is too large and falls under refinement:
   * the first gives an upper, the second a lower bound of the leak rate.
   */
  class PotentialProblem
  {
  public:
    using Vector   = UnknownsVector;
    using Iterator = dealii::DoFHandler<2>::active_cell_iterator;

    /** Set up the one of the two problems that has this @p coefficient. */
    PotentialProblem(FlowMesh             &mesh,
                     const MomentSet      &set,
                     GapField::Coefficient coefficient);

    /** Take the coefficient on all cells of the current mesh from @p gap, and drop the
     * weights. The solution on this mesh, or that of the previous mesh interpolated to
     * it, is kept as a start value. Collective. */
    void take_coefficient(const GapField &gap);

    /** Take the solution of @p other, the same problem for another gap on the same mesh,
     * as a start value. */
    void
    start_from(const PotentialProblem &other)
    {
      distributed = other.distributed;
    }

    /** Multiply the conductivity of each owned cell by one of @p weights; none: by 1. */
    void
    set_weights(const std::vector<double> &weights)
    {
      conductivity_weights = weights;
    }

    /**
     * Solve, from the present solution, until the energy is known to @p accuracy.
     * Collective.
     */
    LinearSolve solve(const LinearAccuracy &accuracy);

    /** Return ∫ c |∇u|² of the potential u, with weights. Collective. */
    double energy() const;

    /** Keep the solution, to interpolate it to the mesh that refinement is to make. */
    void prepare_for_refinement();

    /** The owned cells. Their positions here are their numbers in all functions. */
    const std::vector<Iterator> &
    cells() const
    {
      return owned_cells;
    }

    /** Get the nodal values of the potential on a cell, up to a constant for ψ. */
    void cell_values(std::size_t cell, std::vector<double> &values) const;

    /** Return the energy of a cell with these nodal @p values. */
    double cell_energy(std::size_t cell, const std::vector<double> &values) const;

    /** The factor on the coefficient of a cell: its weight, inverted for 1/K. */
    double
    coefficient_weight(const std::size_t cell) const
    {
      if (conductivity_weights.empty())
        return 1.;
      const double weight = conductivity_weights[cell];
      return is_pressure() ? weight : 1. / weight;
    }

    /** The weights of the conductivity, one for each owned cell, or none. */
    const std::vector<double> &
    weights() const
    {
      return conductivity_weights;
    }

    /** Mean of the coefficient over a cell, without weights. */
    double
    unweighted_mean(const std::size_t cell) const
    {
      return coefficient.means[cell];
    }

    /** The same, with weights. */
    double
    mean_coefficient(const std::size_t cell) const
    {
      return coefficient_weight(cell) * coefficient.means[cell];
    }

    /** True where the coefficient does not vanish. */
    bool
    is_active(const std::size_t cell) const
    {
      return coefficient.means[cell] > 0;
    }

    /** Which of the two problems this is. */
    bool
    is_pressure() const
    {
      return kind_of_coefficient == GapField::Coefficient::conductivity ||
             kind_of_coefficient == GapField::Coefficient::largest_conductivity;
    }

    /** Which function of the gap the coefficient is, apart from weights. */
    GapField::Coefficient
    coefficient_kind() const
    {
      return kind_of_coefficient;
    }

    /** Number of unknowns that are neither constrained nor pinned. */
    dealii::types::global_dof_index
    n_unknowns() const
    {
      return n_active_unknowns;
    }

    const dealii::DoFHandler<2> &
    dof_handler() const
    {
      return dofs;
    }

    /** The solution, with ghost values; empty before take_coefficient(). */
    const Vector &
    solution() const
    {
      return ghosted;
    }

  private:
    void           number_unknowns();
    void           complete_solution();
    void           constrain_boundary();
    UnknownsMatrix empty_matrix() const;
    void           assemble(UnknownsMatrix &matrix, Vector &right) const;

    /** Whether the potential is only determined up to a constant. */
    bool
    is_free() const
    {
      return !is_pressure() && (mesh.seal() == nullptr || mesh.seal()->is_ring);
    }

    void pin_one_value(UnknownsMatrix &matrix) const;
    void pin_unreached_rows(UnknownsMatrix &matrix);

    /** Add the prescribed part of ψ, which the solution lacks, up to a constant. */
    void add_background(const Iterator &cell, std::vector<double> &values) const;

    /**
     * Find the multivalued part of a ring's stream function: the angle around the pole in
     * turns, with the sign for which its curl flows from inlet to outlet. Also complete
     * the constraints of the single-valued part: at hanging nodes the sum of both must be
     * continuous, not that part alone. Collective.
     */
    void find_multivalued_part();

    GapField::Coefficient              kind_of_coefficient;
    FlowMesh                          &mesh;
    dealii::FE_Q<2>                    fe;
    dealii::DoFHandler<2>              dofs;
    std::vector<Iterator>              owned_cells;
    dealii::AffineConstraints<double>  constraints;
    Vector                             distributed, ghosted; // the solution
    CellCoefficient                    coefficient;
    mutable dealii::FullMatrix<double> cell_matrix;          // for cell_energy()
    std::vector<double>                conductivity_weights; // empty: all one
    Vector                             angles; // of a ring, with ghost values
    dealii::types::global_dof_index    n_active_unknowns = 0;

    using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;
    std::unique_ptr<Transfer> transfer; // to the next mesh, while it is made
  };
} // namespace strait
