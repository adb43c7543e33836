// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_enrichment_h
#define strait_flow_enrichment_h

#include <strait/flow/potential_problem.h>

#include <deal.II/fe/fe_q_iso_q1.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <vector>

namespace strait
{
  /**
   * Values of a potential at the 3 × 3 nodes of each owned cell, in the order of
   * FE_Q(2), up to a constant for each cell. Between them the potential is bilinear
   * on the four children of the cell.
   */
  struct EnrichedSolution
  {
    using Nodes = std::array<double, 9>;

    std::vector<Nodes>  values;
    std::vector<double> cell_energies;
    double              energy = 0.; // of all ranks
  };

  /**
   * A solution of degree 1, improved without another mesh: its values are kept, the
   * nodes that a uniform refinement would add are freed and relaxed by a few steps
   * of conjugate gradients. What comes out is admissible, so its energy is a bound
   * like that of the solution it starts from, and never a worse one with the same
   * coefficient. The centre of a cell is eliminated, which leaves one unknown for
   * each edge of the mesh and four of them in a cell.
   */
  class Enrichment
  {
  public:
    explicit Enrichment(const FlowMesh &mesh);

    /** Number the new nodes of the current mesh, for both problems. Collective. */
    void set_up();

    /** The children of the owned cells, four after four. */
    const std::vector<GridCell> &
    children() const
    {
      return child_cells;
    }

    /**
     * Relax the solution of @p problem. @p answers hold its coefficient on
     * children(). Collective.
     */
    EnrichedSolution relax(const PotentialProblem &problem,
                           const CellAnswers      &answers,
                           unsigned int            n_steps) const;

    /** ∫ ∇u·curl v over an owned cell of two enriched solutions. */
    double gradient_times_curl(const EnrichedSolution::Nodes &u,
                               const EnrichedSolution::Nodes &v) const;

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
    using Nodes  = EnrichedSolution::Nodes;

    /** A node on the rim of a cell depends on this freed one. */
    struct Dependence
    {
      unsigned int node;
      unsigned int column; // position in the list of the cell's freed nodes
      double       weight;
    };

    /** Freed nodes of a cell, and how its rim depends on them. */
    struct CellNodes
    {
      std::size_t  first_index      = 0;
      unsigned int n_indices        = 0;
      std::size_t  first_dependence = 0;
      unsigned int n_dependences    = 0;
      unsigned int at_reservoir     = 0; // bit f: face f is at inlet or outlet
    };

    class LocalSystems;

    void list_nodes();
    void macro_matrix(std::size_t                           cell,
                      const CellAnswers                    &answers,
                      std::array<std::array<double, 9>, 9> &matrix) const;
    void conjugate_gradients(const LocalSystems &systems,
                             unsigned int        n_steps,
                             Vector             &x,
                             Vector             &r,
                             const Vector       &diagonal) const;

    const FlowMesh                   &mesh;
    ElementMatrix                     element;
    dealii::FE_Q_iso_Q1<2>            fe;
    dealii::DoFHandler<2>             dofs;
    dealii::AffineConstraints<double> constraints;
    Vector                            layout;
    std::vector<GridCell>             cells, child_cells;
    std::vector<CellNodes>            cell_nodes;
    std::vector<unsigned int>         indices; // positions in this rank's part
    std::vector<Dependence>           dependences;
  };
} // namespace strait

#endif
