// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_ring_background_h
#define strait_flow_ring_background_h

#include <strait/flow/flow_mesh.h>
#include <strait/flow/multigrid.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace strait
{
  /**
   * The part of a ring's stream function that has many values: the angle around the pole
   * in turns, of the sign that lets its curl flow from inlet to outlet, at the unknowns
   * of
   * @p dofs, with ghost values. Completes the @p constraints of the other part: where a
   * node hangs, the sum of both must be continuous, not the other one alone. Collective.
   */
  UnknownsVector ring_background(const FlowMesh                    &mesh,
                                 const dealii::DoFHandler<2>       &dofs,
                                 dealii::AffineConstraints<double> &constraints);

  /** Add to the @p values on @p cell those of such a @p background, less that at its
   * first unknown. */
  void add_background_values(const UnknownsVector &background,
                             const dealii::DoFHandler<2>::active_cell_iterator &cell,
                             std::vector<double>                               &values);
} // namespace strait

#endif
