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
   * in turns, of the sign that lets its curl flow from inlet to outlet, interpolated from
   * its values at the unknowns.
   */
  class RingBackground
  {
  public:
    /** Take the angles at the unknowns of @p dofs. Collective. */
    void set_up(const FlowMesh              &mesh,
                const dealii::DoFHandler<2> &dofs,
                const dealii::IndexSet      &owned,
                const dealii::IndexSet      &relevant);

    /** Values on @p cell, less that at its first unknown. */
    void values(const dealii::DoFHandler<2>::active_cell_iterator &cell,
                std::vector<double>                               &values) const;

    /** Where a node hangs, the sum of both parts of the stream function must be
     *  continuous, not the other one alone: complete its constraints so. */
    void complete(dealii::AffineConstraints<double> &constraints,
                  const dealii::IndexSet            &relevant) const;

  private:
    Multigrid::Vector angles;
  };
} // namespace strait

#endif
