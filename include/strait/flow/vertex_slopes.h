// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_vertex_slopes_h
#define strait_flow_vertex_slopes_h

#include <strait/flow/potential_problem.h>

namespace strait
{
  /**
   * |∇| of the potential at the vertices [1/length], the mean over the cells that meet
   * there, at the unknowns of the vertices, with ghost values; for pictures. Collective.
   */
  PotentialProblem::Vector vertex_slopes(const PotentialProblem &problem);
} // namespace strait

#endif
