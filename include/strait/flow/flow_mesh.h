// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>
#include <strait/flow/seal_mesh.h>
#include <strait/interface/gap_field.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <cmath>

namespace strait
{
  /**
   * The quadtree mesh (p4est) of the flow problem, with boundary id 0 at the inlet and 1
   * at the outlet. The mesh of the box is periodic across the flow, and its cells are
   * cells of the quadtree over the grid of the gap. A seal mesh has walls instead, cells
   * of any shape, and curved edges where its boundary is a circle.
   */
  class FlowMesh
  {
  public:
    using Triangulation = dealii::parallel::distributed::Triangulation<2>;

    static constexpr dealii::types::boundary_id inlet          = 0;
    static constexpr dealii::types::boundary_id outlet         = 1;
    static constexpr dealii::types::boundary_id periodic_first = 2;
    static constexpr dealii::types::boundary_id periodic_last  = 3;
    static constexpr dealii::types::boundary_id right_wall     = 2;
    static constexpr dealii::types::boundary_id left_wall      = 3;

    /** Make the coarsest mesh: that of the box, with at least 2 × 2 cells, or that of
     *  @p seal, which must outlive this object. */
    FlowMesh(const GapField &gap,
             FlowDirection   direction,
             const SealMesh *seal = nullptr);

    /** The seal mesh that this mesh was made from; null: the box. */
    const SealMesh *
    seal() const
    {
      return seal_mesh;
    }

    /** The mapping from the unit cell to a cell. */
    const dealii::Mapping<2> &
    mapping() const
    {
      return cell_mapping;
    }

    /** Return the constraints, not closed, that make functions of @p dofs continuous at
     *  hanging nodes and across the periodic boundary, if there is one. They are those
     *  of the locally relevant unknowns. */
    dealii::AffineConstraints<double> continuity(const dealii::DoFHandler<2> &dofs) const;

    Triangulation &
    triangulation()
    {
      return tria;
    }

    const Triangulation &
    triangulation() const
    {
      return tria;
    }

    /** Coordinate number along the flow, 0 or 1. */
    unsigned int
    axis_along() const
    {
      return flow_direction == FlowDirection::x ? 0 : 1;
    }

    const PeriodicGrid &
    grid() const
    {
      return periodic_grid;
    }

    /** Return @p cell as a cell of the grid's quadtree; not for a seal mesh. */
    GridCell grid_cell(const dealii::CellAccessor<2> &cell) const;

    /** Lengths of @p cell along x and y. */
    std::array<double, 2>
    edges(const GridCell &cell) const
    {
      return {std::ldexp(periodic_grid.dx(), cell.exponent),
              std::ldexp(periodic_grid.dy(), cell.exponent)};
    }

    /** The length of the longest edge of @p cell in spacings of the grid. */
    double size_in_spacings(const dealii::CellAccessor<2> &cell) const;

    /** Whether the smallest cells are no larger than the spacing of the grid. Cells of a
     *  seal mesh count like those of the box after as many refinements. */
    bool
    reaches_spacing() const
    {
      return static_cast<int>(tria.n_global_levels()) > root_exponent;
    }

    /** Whether the smallest cells may be divided: p4est must have another level, and an
     *  int must be able to count cells of their children's size. */
    bool can_be_refined() const;

  private:
    void make_box();

    PeriodicGrid        periodic_grid;
    FlowDirection       flow_direction;
    const SealMesh     *seal_mesh;
    int                 root_exponent;
    dealii::MappingQ<2> cell_mapping;
    Triangulation       tria;
  };
} // namespace strait
