// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/flow/seal_mesh.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

namespace strait
{
  namespace
  {
    using dealii::Point;

    constexpr int inlet_id  = static_cast<int>(OutlineKind::inlet),
                  outlet_id = static_cast<int>(OutlineKind::outlet);

    /** Builds a SealMesh, step by step. */
    class Builder
    {
    public:
      Builder(const MeshFile &file_, const std::string &name_)
        : file(file_)
        , name(name_)
      {
      }

      SealMesh
      build()
      {
        mesh.points = file.points;
        take_cells();
        find_edges();
        check_crossings();
        find_circles();
        recognise_shape(mesh, boundary, name);
        check_bent_cells();
        return std::move(mesh);
      }

    private:
      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("The mesh '" + name + "' " + what + ".");
      }

      std::string
      place(const unsigned int p) const
      {
        return format("(%.6g, %.6g)", mesh.points[p][0], mesh.points[p][1]);
      }

      void
      take_cells()
      {
        for (std::array<unsigned int, 4> corners : file.quadrilaterals)
          {
            int n_left_turns = 0;
            for (unsigned int v = 0; v < 4; ++v)
              {
                const double area =
                  turn(corners[v], corners[(v + 1) % 4], corners[(v + 2) % 4]);
                n_left_turns += area > 0 ? 1 : area < 0 ? -1 : 0;
              }
            if (n_left_turns == -4)
              std::swap(corners[1], corners[3]);
            else if (n_left_turns != 4)
              fail("has a cell at " + place(corners[0]) +
                   " that is no convex quadrilateral");
            mesh.cells.push_back(corners);
          }
      }

      /** Find the boundary edges, by their first points. */
      void
      find_edges()
      {
        std::set<std::pair<unsigned int, unsigned int>> edges; // with a cell to the left
        for (const auto &corners : mesh.cells)
          for (unsigned int v = 0; v < 4; ++v)
            if (!edges.emplace(corners[v], corners[(v + 1) % 4]).second)
              fail("has cells that overlap at " + place(corners[v]));
        for (const auto &[from, to] : edges)
          if (edges.count({to, from}) == 0 &&
              !boundary.emplace(from, SealMesh::Edge{from, to}).second)
            fail("touches itself at " + place(from));
      }

      /** Twice the area of the triangle of three points; positive if it turns left. */
      double
      turn(const unsigned int a, const unsigned int b, const unsigned int c) const
      {
        return (mesh.points[b] - mesh.points[a]) *
               dealii::cross_product_2d(mesh.points[c] - mesh.points[a]);
      }

      /** Whether @p a and @p b lie on different sides of the line through @p edge, by
       * more than rounding: both walls of a slit may have the same place. */
      bool
      lie_apart(const SealMesh::Edge &edge,
                const unsigned int    a,
                const unsigned int    b) const
      {
        const double left  = turn(edge.from, edge.to, a);
        const double right = turn(edge.from, edge.to, b);
        return left * right < 0. &&
               std::min(std::abs(left), std::abs(right)) >
                 rounding * (mesh.points[edge.to] - mesh.points[edge.from]).norm_square();
      }

      /** A connected mesh whose boundary does not cross itself does not overlap itself
       *  either. */
      void
      check_crossings() const
      {
        const auto range = [this](const SealMesh::Edge &edge) {
          return std::minmax(mesh.points[edge.from][0], mesh.points[edge.to][0]);
        };
        std::vector<SealMesh::Edge> edges;
        for (const auto &entry : boundary)
          edges.push_back(entry.second);
        std::sort(edges.begin(), edges.end(), [&range](const auto &a, const auto &b) {
          return range(a).first < range(b).first;
        });
        for (auto one = edges.begin(); one != edges.end(); ++one)
          for (auto other = one + 1;
               other != edges.end() && range(*other).first <= range(*one).second;
               ++other)
            if (lie_apart(*one, other->from, other->to) &&
                lie_apart(*other, one->from, one->to))
              fail("has a boundary that crosses itself at the edges from " +
                   place(one->from) + " and " + place(other->from) +
                   ", so that cells overlap");
      }

      SealMesh::Edge *
      find(const MeshFile::Line &line)
      {
        for (unsigned int end = 0; end < 2; ++end)
          {
            const auto edge = boundary.find(line.points[end]);
            if (edge != boundary.end() && edge->second.to == line.points[1 - end])
              return &edge->second;
          }
        return nullptr;
      }

      void
      find_circles()
      {
        std::map<int, std::vector<SealMesh::Edge *>> edges_of;
        for (const MeshFile::Line &line : file.lines)
          {
            SealMesh::Edge *edge = find(line);
            if (edge != nullptr)
              edges_of[line.curve].push_back(edge);
            if (line.boundary_id != inlet_id && line.boundary_id != outlet_id)
              continue;
            if (edge == nullptr)
              fail("has an inlet or outlet at " + place(line.points[0]) +
                   " that is not on its boundary");
            edge->kind = static_cast<OutlineKind>(line.boundary_id);
          }
        for (const auto &[curve, edges] : edges_of)
          {
            std::vector<Point<2>> points;
            for (const SealMesh::Edge *edge : edges)
              {
                points.push_back(mesh.points[edge->from]);
                points.push_back(mesh.points[edge->to]);
              }
            if (const auto circle = fit_circle(points))
              {
                for (SealMesh::Edge *edge : edges)
                  edge->circle = static_cast<int>(mesh.circles.size());
                mesh.circles.push_back(*circle);
              }
          }
      }

      /** A side that is bent onto its circle must not cut through its cell, nor through
       *  one of the cells that this is refined into, whose inner sides are straight. */
      void
      check_bent_cells() const
      {
        if (mesh.circles.empty())
          return;
        // The height of an arc falls by four with each refinement, the thickness of a
        // cell by two. Of nine rings of two or three layers whose cells turn inside out,
        // those of three do so unrefined, of five after one refinement, and of one after
        // two; five refinements find no other.
        constexpr int            n_refinements = 3;
        dealii::Triangulation<2> cells;
        make_triangulation(mesh, cells);
        const dealii::MappingQ<2>   mapping(SealMesh::degree_of_arcs);
        const dealii::FE_Nothing<2> nothing;
        dealii::FEValues<2>         values(mapping,
                                   nothing,
                                   dealii::QIterated<2>(dealii::QTrapezoid<1>(), 8),
                                   dealii::update_jacobians);
        for (int level = 0; level <= n_refinements; ++level)
          {
            for (const auto &cell : cells.active_cell_iterators_on_level(level))
              {
                if (!is_bent(*cell))
                  continue;
                values.reinit(cell);
                for (const unsigned int q : values.quadrature_point_indices())
                  if (!(values.jacobian(q).determinant() > 0.))
                    fail(format("has a cell at (%.6g, %.6g)",
                                cell->center()[0],
                                cell->center()[1]) +
                         " that turns inside out, now or refined, where its side is bent "
                         "onto a circle: put more cells along that circle");
                cell->set_refine_flag();
              }
            cells.execute_coarsening_and_refinement();
          }
      }

      static bool
      is_bent(const dealii::CellAccessor<2> &cell)
      {
        return std::any_of(cell.face_indices().begin(),
                           cell.face_indices().end(),
                           [&](const unsigned int face) {
                             return cell.face(face)->manifold_id() !=
                                    dealii::numbers::flat_manifold_id;
                           });
      }

      const MeshFile                        &file;
      const std::string                     &name;
      SealMesh                               mesh;
      std::map<unsigned int, SealMesh::Edge> boundary; // by the first point
    };
  } // namespace

  void
  make_triangulation(const SealMesh &seal, dealii::Triangulation<2> &tria)
  {
    std::vector<dealii::Point<2>>    points = seal.points;
    std::vector<dealii::CellData<2>> cells;
    dealii::SubCellData              boundary;
    for (const auto &corners : seal.cells)
      cells.emplace_back().vertices = {corners[0], corners[1], corners[3], corners[2]};
    for (const SealMesh::Edge &edge : seal.edges)
      {
        dealii::CellData<1> line;
        line.vertices    = {edge.from, edge.to};
        line.boundary_id = static_cast<dealii::types::boundary_id>(edge.kind);
        if (edge.circle >= 0)
          line.manifold_id = static_cast<dealii::types::manifold_id>(edge.circle);
        boundary.boundary_lines.push_back(line);
      }
    dealii::GridTools::delete_unused_vertices(points, cells, boundary);
    dealii::GridTools::consistently_order_cells(cells);
    tria.create_triangulation(points, cells, boundary);
    for (std::size_t k = 0; k < seal.circles.size(); ++k)
      tria.set_manifold(static_cast<dealii::types::manifold_id>(k),
                        dealii::SphericalManifold<2>(seal.circles[k].centre));
  }

  SealMesh
  make_seal_mesh(const MeshFile &file, const std::string &name)
  {
    return Builder(file, name).build();
  }

  SealMesh
  read_seal_mesh(const std::string &path, const PeriodicGrid &grid, MPI_Comm comm)
  {
    std::string text;
    run_on_root(comm, [&]() {
      std::ifstream in(path);
      if (!in || std::filesystem::is_directory(path))
        throw InputError("Cannot read the mesh '" + path +
                         "'; check Fluid/Mesh, which counts from the scene's folder.");
      text.assign(std::istreambuf_iterator<char>(in), {});
    });
    SealMesh mesh = make_seal_mesh(parse_mesh_file(broadcast(comm, text), path), path);
    const double slack = rounding * std::max(grid.lx, grid.ly);
    for (const OutlineEdge &e : mesh.outline(.25 * std::min(grid.dx(), grid.dy())))
      if (!(e.x0 >= -slack && e.x0 <= grid.lx + slack && e.y0 >= -slack &&
            e.y0 <= grid.ly + slack))
        throw InputError(
          "The mesh '" + path + "' leaves the box" +
          format(" of %.6g × %.6g at (%.6g, %.6g)", grid.lx, grid.ly, e.x0, e.y0) +
          "; both are in the scene's unit of length (Surface/Size).");
    return mesh;
  }
} // namespace strait
