// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_bracket_h
#define strait_flow_bracket_h

#include <strait/flow/hierarchical_correction.h>

#include <deal.II/lac/vector.h>

namespace strait
{
  /** Bounds of the conductance Q/Δp on one mesh. */
  struct Bracket
  {
    double lower = 0.;
    double upper = 0.;

    /** Of each active cell: what it contributes to upper − lower, over upper. */
    dealii::Vector<float> contributions;

    /**
     * The bounds, further apart by what the quadrature of the coefficients may be
     * wrong by: the energies E of the same functions become E' + Σ |E'_c − E_c| with
     * the finer quadrature E', the sum over the cells c. A throat or a barrier that is
     * narrower than its cells shows in these differences. Equal to the bounds until
     * allow_for_quadrature().
     */
    double safe_lower = lower;
    double safe_upper = upper;

    /** Of each active cell: the differences of both energies, over the energies. */
    dealii::Vector<float> quadrature_errors;
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

  /** Find safe bounds and quadrature_errors of plain_bracket(); corrected_bracket() has
   *  them. Nothing to find where the bounds are rigorous. Collective. */
  void allow_for_quadrature(Bracket                &bracket,
                            const FlowMesh         &mesh,
                            const GapField         &gap,
                            const PotentialProblem &pressure,
                            const PotentialProblem &stream_function);
} // namespace strait

#endif
