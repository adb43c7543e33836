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
   *  of iteration. */
  struct CellCoefficient
  {
    std::vector<double> means; // over a cell; zero where nothing flows

    /** Of A_ij = ∫ c ∇φ_i·∇φ_j the lower halves, row by row. */
    std::vector<double> entries;

    /** A of a cell. */
    void stiffness(std::size_t cell, dealii::FullMatrix<double> &matrix) const;
  };

  /**
   * Take the coefficient from @p gap on the cells of @p mesh: of the box, exactly, the
   * gap being on the grid of the mesh or one with half, a quarter … of its points each
   * way; of a seal mesh, by quadrature. The potentials are those of @p fe: FE_Q of that
   * @p degree, or FE_Q_iso_Q1(2) with a degree of 1, bilinear on the four children of a
   * cell. Collective.
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
   * - pressure, with a conductivity K: p = 1 at the inlet, 0 at the outlet; minimises
   *   ∫ K |∇p|², whose minimum is Q/Δp;
   * - stream function, with a resistivity 1/K: ψ = ±(coordinate across)/(length across)
   *   + periodic part, free at the reservoirs; its curl is a flux of total 1 without
   *   sources, and it minimises ∫ |∇ψ|²/K, whose minimum is Δp/Q. On a strip ψ is 0 at
   *   the right and 1 at the left wall; around a ring it is ±(angle)/2π + a function of
   *   one value.
   * Both are conforming, so each energy is too large and falls under refinement:
   * the first gives an upper, the second a lower bound of the leak rate.
   */
  class PotentialProblem
  {
  public:
    using Vector   = UnknownsVector;
    using Iterator = dealii::DoFHandler<2>::active_cell_iterator;

    /** That of the two to which the @p coefficient belongs. */
    PotentialProblem(FlowMesh             &mesh,
                     const MomentSet      &set,
                     GapField::Coefficient coefficient);

    /** Ask @p gap for the coefficient on all cells of the current mesh, which then have
     * no weights. The solution on the same mesh, or that interpolated from the mesh
     * before, is kept as a start. Collective. */
    void take_coefficient(const GapField &gap);

    /** Take the solution of @p other, the same problem of another gap on the same mesh,
     * as a start. */
    void
    start_from(const PotentialProblem &other)
    {
      distributed = other.distributed;
    }

    /** Multiply the conductivity of each owned cell with one of @p weights. */
    void
    set_weights(const std::vector<double> &weights)
    {
      conductivity_weights = weights;
    }

    /**
     * Solve from the solution that is there, until the energy is known to @p accuracy.
     * Collective.
     */
    LinearSolve solve(const LinearAccuracy &accuracy);

    /** ∫ coefficient |∇·|². Collective. */
    double energy() const;

    /** Keep the solution for the mesh that is about to be refined. */
    void prepare_for_refinement();

    /** The owned cells. Their positions are the numbers by which they are asked for. */
    const std::vector<Iterator> &
    cells() const
    {
      return owned_cells;
    }

    /** Values of the potential on a cell, up to a constant for ψ. */
    void cell_values(std::size_t cell, std::vector<double> &values) const;

    /** Energy of a cell with these @p values. */
    double cell_energy(std::size_t cell, const std::vector<double> &values) const;

    /** What the weights multiply the coefficient of a cell with. */
    double
    coefficient_weight(const std::size_t cell) const
    {
      if (conductivity_weights.empty())
        return 1.;
      const double weight = conductivity_weights[cell];
      return is_pressure() ? weight : 1. / weight;
    }

    /** One for each owned cell, or none. */
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

    /** The same with them. */
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

    /** What the coefficient is of the gap, apart from weights. */
    GapField::Coefficient
    coefficient_kind() const
    {
      return kind_of_coefficient;
    }

    /** Unknowns that the solver really solves for. */
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

    /** Whether a constant may be added to the potential. */
    bool
    is_free() const
    {
      return !is_pressure() && (mesh.seal() == nullptr || mesh.seal()->is_ring);
    }

    void pin_one_value(UnknownsMatrix &matrix) const;
    void pin_unreached_rows(UnknownsMatrix &matrix);

    /** Add what the potential has besides the solution, up to a constant. */
    void add_background(const Iterator &cell, std::vector<double> &values) const;

    /**
     * Find the part of a ring's stream function that has many values: the angle around
     * the pole in turns, of the sign that lets its curl flow from inlet to outlet.
     * Completes the constraints of the other part: where a node hangs, the sum of both
     * must be continuous, not the other one alone. Collective.
     */
    void find_angles();

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
    std::unique_ptr<Transfer> transfer; // to the mesh that is being made
  };
} // namespace strait
