// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_bracket_h
#define strait_flow_bracket_h

#include <strait/flow/hierarchical_correction.h>

#include <deal.II/lac/vector.h>

#include <functional>
#include <vector>

namespace strait
{
  /** An owned cell of the mesh that both problems share. */
  struct CellSolutions
  {
    PotentialProblem::Iterator cell;
    std::size_t                number = 0; // among the owned cells
    std::vector<double>        p, psi;     // PotentialProblem::cell_values()
  };

  /** Call @p visit for each of them in turn. */
  void for_each_owned_cell(const PotentialProblem &pressure,
                           const PotentialProblem &stream_function,
                           const std::function<void(const CellSolutions &)> &visit);

  /** Bounds of the conductance Q/Δp on one mesh. */
  struct Bracket
  {
    double lower = 0.;
    double upper = 0.;

    /** Of each active cell: what it contributes to upper − lower, over upper. */
    dealii::Vector<float> contributions;
  };

  /**
   * The bracket of a pressure p and a stream function ψ. A cell contributes
   * ∫ K |∇p + Q_lower/Δp K⁻¹ curl ψ|², which is zero where the flux of both agrees.
   */
  Bracket plain_bracket(const FlowMesh         &mesh,
                        const PotentialProblem &pressure,
                        const PotentialProblem &stream_function);

  /**
   * The same after correction of both solutions, which must be of degree 1: closer
   * bounds, to stop on. Its contributions are no guide for refinement: correction stops a
   * short cut through a coarse cell after the fact, when the pressure around has
   * already adjusted to it. @p correction is set up anew. Collective.
   */
  Bracket corrected_bracket(const FlowMesh         &mesh,
                            const GapField         &gap,
                            const PotentialProblem &pressure,
                            const PotentialProblem &stream_function,
                            HierarchicalCorrection &correction);
} // namespace strait

#endif
