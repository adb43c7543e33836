// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_bracket_h
#define strait_flow_bracket_h

#include <strait/flow/potential_problem.h>

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
  };

  /**
   * The bracket of a pressure p and a stream function ψ. A cell contributes
   * ∫ K |∇p + Q_lower/Δp K⁻¹ curl ψ|², which is zero where the flux of both agrees.
   * Collective.
   */
  Bracket plain_bracket(const PotentialProblem &pressure,
                        const PotentialProblem &stream_function);
} // namespace strait

#endif
