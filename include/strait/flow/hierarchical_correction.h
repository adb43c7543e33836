// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_hierarchical_correction_h
#define strait_flow_hierarchical_correction_h

#include <strait/flow/potential_problem.h>

#include <deal.II/fe/fe_q_iso_q1.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

namespace strait
{
  /**
   * Values of a potential at the 3 × 3 nodes of each owned cell, in the order of
   * FE_Q(2), up to a constant for each cell. Between them the potential is bilinear
   * on the four children of the cell.
   */
  struct CorrectedSolution
  {
    using Nodes = std::array<double, 9>;

    std::vector<Nodes>  values;
    std::vector<double> cell_energies;
    double              energy = 0.; // of all ranks
  };

  /** The nodes that a correction frees, as the owned cells see them. */
  struct CorrectionNodes
  {
    /** A node on the rim of a cell depends on this freed one. */
    struct Dependence
    {
      unsigned int node;
      unsigned int column; // position in the list of the cell's freed nodes
      double       weight;
    };

    /** The freed nodes of one coarse cell. */
    struct Cell
    {
      std::size_t  first_index      = 0;
      unsigned int n_indices        = 0;
      std::size_t  first_dependence = 0;
      unsigned int n_dependences    = 0;
      unsigned int at_reservoir     = 0; // bit f: face f is at inlet or outlet
      unsigned int at_wall          = 0; // likewise
    };

    std::vector<Cell>         cells;
    std::vector<unsigned int> indices; // positions in this rank's part of a vector
    std::vector<Dependence>   dependences;
  };

  /**
   * A solution of degree 1, improved without another mesh: its values are kept, the
   * nodes that a uniform refinement would add are freed and relaxed by a few steps
   * of conjugate gradients. What comes out is admissible, so its energy is a bound
   * like that of the solution it starts from, and never a worse one with the same
   * coefficient. The centre of a cell is eliminated, which leaves one unknown for
   * each edge of the mesh and four of them in a cell.
   */
  class HierarchicalCorrection
  {
  public:
    explicit HierarchicalCorrection(const FlowMesh &mesh);

    /** Number the new nodes of the current mesh, for both problems. Collective. */
    void set_up();

    /** Relax the solution of @p problem, with its coefficient taken anew from @p gap.
     *  Collective. */
    CorrectedSolution relax(const PotentialProblem &problem, const GapField &gap);

    /** Give back what is kept of the coefficients from mesh to mesh. */
    void
    release()
    {
      on_children.clear();
    }

    /** ∫ ∇u·curl v over an owned cell of two corrected solutions. */
    double gradient_times_curl(const CorrectedSolution::Nodes &u,
                               const CorrectedSolution::Nodes &v) const;

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
    using Nodes  = CorrectedSolution::Nodes;

    void list_nodes();

    CellCoefficient &coefficient_on_children(GapField::Coefficient kind);

    const FlowMesh                                                   &mesh;
    ElementMatrix                                                     element;
    dealii::FE_Q_iso_Q1<2>                                            fe;
    dealii::DoFHandler<2>                                             dofs;
    dealii::AffineConstraints<double>                                 constraints;
    Vector                                                            layout;
    CorrectionNodes                                                   nodes;
    std::map<GapField::Coefficient, std::unique_ptr<CellCoefficient>> on_children;
  };
} // namespace strait

#endif
