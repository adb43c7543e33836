// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/flow/seal_mesh.h>

#include <algorithm>
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
        find_circles();
        recognise_shape(mesh, boundary, name);
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
                const auto a =
                  mesh.points[corners[(v + 1) % 4]] - mesh.points[corners[v]];
                const auto b =
                  mesh.points[corners[(v + 2) % 4]] - mesh.points[corners[(v + 1) % 4]];
                const double turn = a[0] * b[1] - a[1] * b[0];
                n_left_turns += turn > 0 ? 1 : turn < 0 ? -1 : 0;
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

      const MeshFile                        &file;
      const std::string                     &name;
      SealMesh                               mesh;
      std::map<unsigned int, SealMesh::Edge> boundary; // by the first point
    };
  } // namespace

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
