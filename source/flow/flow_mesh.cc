// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/flow_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Return the exponent of the largest cells of the box. deal.II needs two of them
     *  across for periodicity. */
    int
    exponent_of_roots(const PeriodicGrid &grid)
    {
      int e = grid.n_halvings();
      while (e > 0 && std::min(grid.nx, grid.ny) >> e < 2)
        --e;
      return e;
    }
  } // namespace

  FlowMesh::FlowMesh(const GapField     &gap,
                     const FlowDirection direction,
                     const SealMesh     *seal)
    : periodic_grid(gap.layout().grid())
    , flow_direction(direction)
    , seal_mesh(seal)
    , root_exponent(exponent_of_roots(periodic_grid))
    , cell_mapping(seal != nullptr && !seal->circles.empty() ? SealMesh::degree_of_arcs
                                                             : 1)
    , tria(gap.layout().communicator())
  {
    if (seal_mesh == nullptr)
      make_box();
    else
      make_triangulation(*seal_mesh, tria);
  }

  void
  FlowMesh::make_box()
  {
    const std::vector<unsigned int> n_roots = {
      static_cast<unsigned int>(periodic_grid.nx >> root_exponent),
      static_cast<unsigned int>(periodic_grid.ny >> root_exponent)};
    dealii::GridGenerator::subdivided_hyper_rectangle(
      tria, n_roots, {0., 0.}, {periodic_grid.lx, periodic_grid.ly}, true);
    // The ends along x now have the ids 0 and 1, those along y have 2 and 3.
    if (axis_along() == 1)
      for (const auto &face : tria.active_face_iterators())
        if (face->at_boundary())
          face->set_boundary_id((face->boundary_id() + 2) % 4);
    std::vector<dealii::GridTools::PeriodicFacePair<Triangulation::cell_iterator>> pairs;
    dealii::GridTools::collect_periodic_faces(
      tria, periodic_first, periodic_last, 1 - axis_along(), pairs);
    tria.add_periodicity(pairs);
  }

  GridCell
  FlowMesh::grid_cell(const dealii::CellAccessor<2> &cell) const
  {
    GridCell result;
    result.exponent            = root_exponent - cell.level();
    const auto [width, height] = edges(result);
    result.i                   = static_cast<int>(std::lround(cell.vertex(0)[0] / width));
    result.j = static_cast<int>(std::lround(cell.vertex(0)[1] / height));
    return result;
  }

  double
  FlowMesh::size_in_spacings(const dealii::CellAccessor<2> &cell) const
  {
    double longest = 0.;
    for (const unsigned int f : cell.face_indices())
      {
        const auto edge = cell.face(f)->vertex(1) - cell.face(f)->vertex(0);
        longest         = std::max(longest,
                           std::hypot(edge[0] / periodic_grid.dx(),
                                      edge[1] / periodic_grid.dy()));
      }
    return longest;
  }

  bool
  FlowMesh::can_be_refined() const
  {
    // p4est has 30 levels, an int 31 bits; the children of cells are counted as well.
    constexpr int most  = 29;
    const int     level = static_cast<int>(tria.n_global_levels()) - 1;
    return level + 1 < most && (seal_mesh != nullptr ||
                                std::ldexp(std::max(periodic_grid.nx, periodic_grid.ny),
                                           level - root_exponent) < std::ldexp(1., most));
  }

  dealii::AffineConstraints<double>
  FlowMesh::continuity(const dealii::DoFHandler<2> &dofs) const
  {
    dealii::AffineConstraints<double> constraints(
      dealii::DoFTools::extract_locally_relevant_dofs(dofs));
    dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);
    if (seal_mesh == nullptr)
      dealii::DoFTools::make_periodicity_constraints(
        dofs, periodic_first, periodic_last, 1 - axis_along(), constraints);
    return constraints;
  }
} // namespace strait
