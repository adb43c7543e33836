// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_hidden_flow_h
#define strait_flow_hidden_flow_h

#include <strait/flow/bracket.h>
#include <strait/percolation/channel.h>

namespace strait
{
  /**
   * Of each active cell: the flow through it on which pressure and stream function
   * disagree, over the whole one, times the part of the pressure drop that the stream
   * function would take to let it pass, at most one.
   *
   * A coarse cell lets the pressure leak through a barrier, or bars the stream function's
   * way, and costs them nothing: what that changes is at other throats, where
   * Bracket::contributions show it and refinement does not help. These flows show the
   * cell itself. In the wide parts of a channel, where the pressure on coarse cells
   * spreads the flow over many of them, those on the first path of @p channel, if it has
   * one, and beside it count as if all passed there, or what passes a throat as wide as
   * long.
   *
   * The flows are those of uniform coefficients, the means of the cell. @p bracket is
   * that of both solutions (plain_bracket()).
   */
  dealii::Vector<float> hidden_flows(const FlowMesh         &mesh,
                                     const GapField         &gap,
                                     const Bracket          &bracket,
                                     const PotentialProblem &pressure,
                                     const PotentialProblem &stream_function,
                                     const Channel          &channel);
} // namespace strait

#endif
