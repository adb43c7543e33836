// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_marking_h
#define strait_flow_marking_h

#include <strait/flow/bracket.h>

namespace strait
{
  /** What another mesh must leave of the bracket at most to pay. One closer to one makes
   *  more meshes in vain where the grid is too coarse, a smaller one gives up where the
   *  bracket narrows slowly. */
  constexpr double progress = .97;

  /**
   * Mark the cells to refine, at most @p affordable of all, for a bracket of which the
   * part @p excess is too much: those that contribute more than others, and those that
   * hide more than the part @p largest_hidden of its width (hidden_flows()). Returns
   * false, with none marked, if there are none or if so few could be that another mesh
   * does not pay. Collective.
   */
  bool mark(FlowMesh::Triangulation     &tria,
            const Bracket               &bracket,
            const dealii::Vector<float> &hidden,
            double                       largest_hidden,
            double                       excess,
            double                       affordable);
} // namespace strait

#endif
