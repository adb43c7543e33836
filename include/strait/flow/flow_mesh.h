// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_flow_mesh_h
#define strait_flow_flow_mesh_h

#include <strait/base/fluid_parameters.h>
#include <strait/interface/gap_field.h>

#include <deal.II/distributed/tria.h>

#include <cmath>
#include <vector>

namespace strait
{
  /**
   * The quadtree mesh (p4est) of the box on which the fluid flows. Its cells are
   * cells of the quadtree over the grid of the gap; it is periodic across the flow,
   * with boundary id 0 at the inlet and 1 at the outlet.
   */
  class FlowMesh
  {
  public:
    using Triangulation = dealii::parallel::distributed::Triangulation<2>;

    static constexpr dealii::types::boundary_id inlet          = 0;
    static constexpr dealii::types::boundary_id outlet         = 1;
    static constexpr dealii::types::boundary_id periodic_first = 2;
    static constexpr dealii::types::boundary_id periodic_last  = 3;

    /** The coarsest mesh, of at least 2 × 2 cells. */
    FlowMesh(const GapField &gap, FlowDirection direction);

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

    FlowDirection
    direction() const
    {
      return flow_direction;
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

    /** The cell of the grid's quadtree that @p cell is. */
    GridCell grid_cell(const dealii::CellAccessor<2> &cell) const;

    /** The locally owned active cells, in the order of iteration. */
    std::vector<GridCell> owned_grid_cells() const;

    /** Length of @p cell along x. */
    double
    width(const GridCell &cell) const
    {
      return std::ldexp(periodic_grid.dx(), cell.exponent);
    }

    /** Length of @p cell along y. */
    double
    height(const GridCell &cell) const
    {
      return std::ldexp(periodic_grid.dy(), cell.exponent);
    }

    /**
     * Refine to a mesh from which an adaptive cycle finds the leak rate: cells of
     * 2^@p largest_exponent spacings, and the sorted @p critical ones refined. A
     * residual alone does not find a barrier or a channel that is thinner than the
     * cells it starts from.
     */
    void refine_initially(int largest_exponent, const std::vector<GridCell> &critical);

    /** Refine every cell until it is a cell of 2^exponent grid spacings. */
    void refine_uniformly(int exponent);

  private:
    int
    exponent_of_level(const int level) const
    {
      return root_exponent - level;
    }

    PeriodicGrid  periodic_grid;
    FlowDirection flow_direction;
    int           root_exponent;
    Triangulation tria;
  };
} // namespace strait

#endif
