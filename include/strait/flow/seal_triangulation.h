// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_seal_triangulation_h
#define strait_flow_seal_triangulation_h

#include <strait/flow/seal_shape.h>

#include <deal.II/distributed/tria.h>

namespace strait
{
  /** Distributed over the ranks, like that of the box. */
  using SealTriangulation = dealii::parallel::distributed::Triangulation<2>;

  /** Boundary ids: 0 inlet, 1 outlet, 2 right and 3 left wall. */
  dealii::types::boundary_id boundary_id(SealMesh::Part part);

  /** Make @p tria the coarse mesh @p seal, with a manifold for each of its circles. */
  void make_triangulation(const SealMesh &seal, SealTriangulation &tria);

  /** The length of the longest edge of @p cell in spacings of @p grid. */
  double size_in_spacings(const dealii::CellAccessor<2> &cell, const PeriodicGrid &grid);

  /** Refine all cells until none is larger than @p largest spacings. Collective. */
  void refine_to_size(SealTriangulation &tria, const PeriodicGrid &grid, double largest);
} // namespace strait

#endif
