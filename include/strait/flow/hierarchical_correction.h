// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/potential_problem.h>

#include <deal.II/fe/fe_q_iso_q1.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace strait
{
  /** The nodes that a correction frees, as cells see them, one cell after the other. */
  struct FreedNodes
  {
    /** A node on the rim of the cell depends on this freed one. */
    struct Dependence
    {
      unsigned int node;
      unsigned int column; // position among the indices of the cell
      double       weight;
    };

    /** Where the part of a cell begins, and that of the cell before it ends. */
    struct Begin
    {
      std::size_t index = 0, dependence = 0;
    };

    std::vector<unsigned int> indices; // positions in this rank's part of a vector
    std::vector<Dependence>   dependences;
    std::vector<Begin>        begins; // of all cells, and of one after the last
  };

  /**
   * A solution of degree 1, improved without another mesh: its values are kept, the
   * nodes that a uniform refinement would add are freed and relaxed by a few steps
   * of conjugate gradients. Between the 3 × 3 nodes of a cell the potential is then
   * bilinear on each of its four children. What comes out is admissible, so its energy is
   * a bound like that of the solution it starts from, and never a worse one with the same
   * coefficient. The centre of a cell is eliminated, which leaves one unknown for
   * each edge of the mesh and four of them in a cell.
   */
  class HierarchicalCorrection
  {
  public:
    /** Number the new nodes of the current mesh, for both problems. Collective. */
    explicit HierarchicalCorrection(const FlowMesh &mesh);

    /** Relax the solution of @p problem, with its coefficient taken anew from @p gap.
     *  @return the energy that it has then. Collective. */
    double relax(const PotentialProblem &problem, const GapField &gap) const;

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    const FlowMesh        &mesh;
    dealii::FE_Q_iso_Q1<2> fe;
    Vector                 layout;
    FreedNodes             nodes;
  };
} // namespace strait
