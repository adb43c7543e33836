// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_potential_problem_h
#define strait_flow_potential_problem_h

#include <strait/flow/cell_coefficient.h>
#include <strait/flow/element_matrix.h>
#include <strait/flow/flow_mesh.h>
#include <strait/flow/multigrid.h>
#include <strait/flow/ring_background.h>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace strait
{
  /**
   * One of the two variational problems that enclose the leak rate, on the current
   * mesh:
   * - pressure: p = 1 at the inlet, 0 at the outlet; minimises ∫ K |∇p|², whose
   *   minimum is Q/Δp;
   * - stream_function: ψ = ±(coordinate across)/(length across) + periodic part,
   *   free at the reservoirs; its curl is a flux of total 1 without sources, and
   *   it minimises ∫ |∇ψ|²/K, whose minimum is Δp/Q. On a strip ψ is 0 at the right and
   *   1 at the left wall; around a ring it is ±(angle)/2π + a function of one value.
   * Both are conforming, so each energy is too large and falls under refinement:
   * the first gives an upper, the second a lower bound of the leak rate.
   */
  class PotentialProblem
  {
  public:
    /** Which of the two problems. */
    enum class Kind
    {
      pressure,
      stream_function
    };
    using Vector   = Multigrid::Vector;
    using Source   = std::function<double(const dealii::Point<2> &)>;
    using Iterator = dealii::DoFHandler<2>::active_cell_iterator;

    /** With the conductivity or the resistivity, as it fits the kind, unless another
     *  @p coefficient is given. */
    PotentialProblem(Kind                                 kind,
                     FlowMesh                            &mesh,
                     const MomentSet                     &set,
                     std::optional<GapField::Coefficient> coefficient = {});

    /** Number the unknowns of the current mesh, unless that was done, and make room
     *  for the matrix. The solution on the same mesh, or that interpolated from the mesh
     *  before, is kept as a start. Collective. */
    void set_up();

    /** Ask @p gap for the coefficient on all cells, which then have no weights.
     *  Collective. */
    void take_coefficient(const GapField &gap);

    /** Multiply the conductivity of each owned cell with one of @p weights. */
    void
    set_weights(const std::vector<double> &weights)
    {
      conductivity_weights = weights;
    }

    /**
     * Assemble the matrix. @p source, if given, is the right-hand side f of
     * −∇·(K∇p) = f (for verification). Collective.
     */
    void assemble(const Source &source = {});

    /** The same after take_coefficient(). */
    void
    assemble(const GapField &gap, const Source &source = {})
    {
      take_coefficient(gap);
      assemble(source);
    }

    /**
     * Solve from the solution that is there, until the energy is known to the relative
     * @p accuracy. Collective.
     */
    LinearSolve solve(FlowPreconditioner preconditioner, double accuracy);

    /** ∫ coefficient |∇·|². Collective. */
    double energy() const;

    /** Keep the solution for the mesh that is about to be refined. */
    void prepare_for_refinement();

    /** Values of the potential on @p cell, up to a constant for ψ. */
    void cell_values(const Iterator &cell, std::vector<double> &values) const;

    /** Energy of the cell that is number @p owned_cell among the owned ones. */
    double cell_energy(std::size_t owned_cell, const std::vector<double> &values) const;

    /** What the weights make of the coefficient of the owned cell number @p owned_cell.
     */
    double
    coefficient_weight(const std::size_t owned_cell) const
    {
      if (conductivity_weights.empty())
        return 1.;
      const double weight = conductivity_weights[owned_cell];
      return problem_kind == Kind::pressure ? weight : 1. / weight;
    }

    /** One for each owned cell, or none. */
    const std::vector<double> &
    weights() const
    {
      return conductivity_weights;
    }

    /** Mean of the coefficient over a cell, without weights. */
    double
    unweighted_mean(const std::size_t owned_cell) const
    {
      return coefficient->mean(owned_cell);
    }

    /** Mean of the coefficient over the owned cell number @p owned_cell. */
    double
    mean_coefficient(const std::size_t owned_cell) const
    {
      return coefficient_weight(owned_cell) * coefficient->mean(owned_cell);
    }

    /** True where the coefficient does not vanish. */
    bool
    is_active(const std::size_t owned_cell) const
    {
      return coefficient->mean(owned_cell) > 0;
    }

    Kind
    kind() const
    {
      return problem_kind;
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

    const ElementMatrix &
    element_matrix() const
    {
      return element;
    }

    /** The solution, with ghost values. */
    const Vector &
    solution() const
    {
      return ghosted;
    }

  private:
    void number_unknowns();
    void complete_solution();
    void make_constraints();

    /** Whether a constant may be added to the potential. */
    bool
    is_free() const
    {
      return problem_kind == Kind::stream_function &&
             (mesh.seal() == nullptr || mesh.seal()->is_ring);
    }

    void pin_one_value();
    void pin_unreached_rows();

    void background(const Iterator &cell, std::vector<double> &values) const;
    void add_source(const Iterator         &cell,
                    const Source           &source,
                    dealii::Vector<double> &rhs) const;

    Kind                                         problem_kind;
    GapField::Coefficient                        kind_of_coefficient;
    FlowMesh                                    &mesh;
    ElementMatrix                                element;
    dealii::FE_Q<2>                              fe;
    dealii::DoFHandler<2>                        dofs;
    dealii::IndexSet                             owned, relevant;
    dealii::AffineConstraints<double>            constraints;
    Multigrid::Matrix                            matrix; // between assemble() and solve()
    std::vector<dealii::types::global_dof_index> unreached; // by no open cell
    Vector                                       right_hand_side, distributed, ghosted;
    std::unique_ptr<CellCoefficient>             coefficient;
    std::vector<double>                          conductivity_weights; // empty: all one
    std::optional<RingBackground>                ring; // of the stream function on one
    dealii::types::global_dof_index              n_active_unknowns = 0;
    bool                                         is_numbered       = false;

    using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;
    std::unique_ptr<Transfer> transfer;
  };
} // namespace strait

#endif
