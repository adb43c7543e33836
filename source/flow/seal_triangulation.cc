// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/seal_triangulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  using namespace dealii;

  types::boundary_id
  boundary_id(const SealMesh::Part part)
  {
    switch (part)
      {
        case SealMesh::Part::inlet:
          return 0;
        case SealMesh::Part::outlet:
          return 1;
        case SealMesh::Part::right_wall:
          return 2;
        default:
          return 3;
      }
  }

  void
  make_triangulation(const SealMesh &seal, SealTriangulation &tria)
  {
    std::vector<Point<2>>    points = seal.points;
    std::vector<CellData<2>> cells;
    SubCellData              boundary;
    for (const auto &corners : seal.cells)
      {
        cells.emplace_back();
        cells.back().vertices = {corners[0], corners[1], corners[3], corners[2]};
      }
    for (const SealMesh::Edge &edge : seal.edges)
      {
        CellData<1> line;
        line.vertices    = {edge.from, edge.to};
        line.boundary_id = boundary_id(edge.part);
        if (edge.circle >= 0)
          line.manifold_id = static_cast<types::manifold_id>(edge.circle);
        boundary.boundary_lines.push_back(line);
      }
    GridTools::delete_unused_vertices(points, cells, boundary);
    GridTools::consistently_order_cells(cells);
    tria.create_triangulation(points, cells, boundary);
    for (std::size_t k = 0; k < seal.circles.size(); ++k)
      tria.set_manifold(static_cast<types::manifold_id>(k),
                        SphericalManifold<2>(seal.circles[k].centre));
  }

  double
  size_in_spacings(const CellAccessor<2> &cell, const PeriodicGrid &grid)
  {
    double longest = 0.;
    for (const unsigned int f : cell.face_indices())
      {
        const auto edge = cell.face(f)->vertex(1) - cell.face(f)->vertex(0);
        longest = std::max(longest, std::hypot(edge[0] / grid.dx(), edge[1] / grid.dy()));
      }
    return longest;
  }

  void
  refine_to_size(SealTriangulation &tria, const PeriodicGrid &grid, const double largest)
  {
    double size = 0.;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        size = std::max(size, size_in_spacings(*cell, grid));
    size        = Utilities::MPI::max(size, tria.get_communicator());
    const int n = static_cast<int>(std::ceil(std::log2(size / largest)));
    if (n > 0)
      tria.refine_global(n);
  }
} // namespace strait
