// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_bracket_h
#define strait_flow_bracket_h

#include <strait/flow/potential_problem.h>
#include <strait/percolation/channel.h>

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

  /** What another mesh must leave of the bracket at most to pay. One closer to one makes
   *  more meshes in vain where the grid is too coarse, a smaller one gives up where the
   *  bracket narrows slowly. */
  constexpr double progress = .97;

  /**
   * Mark the cells of @p mesh to refine, at most @p affordable of all, for the bracket of
   * both solutions (plain_bracket()), of which the part @p excess is too much: those that
   * contribute more than others, and those on whose flow the solutions disagree by more
   * than the part of the bracket's width that is that of one constriction of the first
   * path of @p channel. Returns false, with none marked, if there are none or if so few
   * could be that another mesh does not pay. Collective.
   */
  bool mark(FlowMesh               &mesh,
            const GapField         &gap,
            const Bracket          &bracket,
            const PotentialProblem &pressure,
            const PotentialProblem &stream_function,
            const Channel          &channel,
            double                  excess,
            double                  affordable);
} // namespace strait

#endif
