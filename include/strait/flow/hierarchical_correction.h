// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/potential_problem.h>

#include <deal.II/fe/fe_q_iso_q1.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace strait
{
  /** The nodes that a correction frees, as each cell sees them, cell after cell. */
  struct FreedNodes
  {
    /** How a node on the rim of a cell depends on one of the freed nodes. */
    struct Dependence
    {
      unsigned int node;
      unsigned int column; // position among the indices of the cell
      double       weight;
    };

    /** Where the entries of a cell begin, and those of the cell before it end. */
    struct Begin
    {
      std::size_t index = 0, dependence = 0;
    };

    std::vector<unsigned int> indices; // positions in this rank's part of a vector
    std::vector<Dependence>   dependences;
    std::vector<Begin>        begins; // of all cells, and one past the last
  };

  /**
   * The hierarchical correction improves a solution of degree 1 without another mesh: it
   * keeps the nodal values, frees the nodes that a uniform refinement would add, and
   * relaxes them by a few steps of conjugate gradients. Between the 3 × 3 nodes of a cell
   * the potential is then bilinear on each of the four children. The result is
   * admissible, so its energy gives a bound like that of the original solution, and never
   * a worse one for the same coefficient. The centre of each cell is eliminated, which
   * leaves one unknown for each edge of the mesh and four of them in a cell.
   */
  class HierarchicalCorrection
  {
  public:
    /** Number the new nodes of the current mesh, for both problems. Collective. */
    explicit HierarchicalCorrection(const FlowMesh &mesh);

    /** Relax a copy of the solution of @p problem, with the coefficient taken anew from
     *  @p gap on the children of the cells. @return its energy afterwards. Collective. */
    double relax(const PotentialProblem &problem, const GapField &gap) const;

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    const FlowMesh        &mesh;
    dealii::FE_Q_iso_Q1<2> fe;
    Vector                 layout;
    FreedNodes             nodes;
  };
} // namespace strait
