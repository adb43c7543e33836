// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /**
   * The coarse mesh of a seal, as the user gives it, with what follows from its boundary.
   *
   * Boundary id 0 is the inlet, 1 the outlet; all other edges are walls. Two shapes are
   * supported, those for which boundary values of the stream function are known:
   * - strip: one closed boundary, of inlet, wall, outlet and wall;
   * - ring: two closed boundaries, one the inlet and the other the outlet.
   *
   * If a curve of the geometry has two or more boundary edges, and all their points lie
   * on a circle, it is taken to be that circle; edges of other curves are straight.
   */
  struct SealMesh
  {
    /** A circle [length]. */
    struct Circle
    {
      dealii::Point<2> centre;
      double           radius = 0.;
    };

    /** A boundary edge, with the mesh to its left. */
    struct Edge
    {
      unsigned int from   = 0;
      unsigned int to     = 0;
      OutlineKind  kind   = OutlineKind::right_wall;
      int          circle = -1; // position in circles; −1: straight
    };

    /** Degree of the mapping of cells with sides on circles. A quartic edge over a
     * quarter of a turn is off its circle by 1e-6 of the radius, and by 32 times less
     * after each refinement. Half of the degree leaves more of that to refinement; double
     * of it costs time at every point. */
    static constexpr unsigned int degree_of_arcs = 4;

    std::vector<dealii::Point<2>>            points;
    std::vector<std::array<unsigned int, 4>> cells; // corners counter-clockwise
    std::vector<Edge>                        edges;
    std::vector<Circle>                      circles;

    bool             is_ring = false;
    dealii::Point<2> pole;                  // of a ring: a point in its hole …
    bool             flows_outwards = true; // … and whether the inlet is around it

    /** Return the boundary in straight pieces, arcs in pieces of at most @p longest. */
    std::vector<OutlineEdge> outline(double longest) const;
  };

  /** What strait uses of a Gmsh file: quadrilaterals and lines between points. */
  struct MeshFile
  {
    /** A line element and the curve that it is part of. */
    struct Line
    {
      std::array<unsigned int, 2> points;
      int                         curve = 0;  // of the geometry
      int boundary_id                   = -1; // number of its physical curve, or −1
    };

    std::vector<dealii::Point<2>>            points;
    std::vector<std::array<unsigned int, 4>> quadrilaterals; // corners in turn
    std::vector<Line>                        lines;
  };

  /**
   * Parse the @p text of a Gmsh file in ASCII format 4.1; @p name stands for it in
   * messages. Points are renumbered from 0, without those of no line or quadrilateral.
   * Throws InputError for another format, other elements (except single points), points
   * off the plane z = 0, and text that makes no sense.
   */
  MeshFile parse_mesh_file(const std::string &text, const std::string &name);

  /**
   * Make the mesh of a Gmsh file; @p name stands for it in messages. Throws InputError,
   * the same on all ranks, if a cell is not convex, or turns inside out where its side is
   * bent onto a circle, if cells overlap, or if the boundary touches or crosses itself or
   * is neither that of a strip nor that of a ring.
   */
  SealMesh make_seal_mesh(const MeshFile &file, const std::string &name);

  /** Make the coarse triangulation of @p seal, with a manifold for each circle. */
  void make_triangulation(const SealMesh &seal, dealii::Triangulation<2> &tria);

  /** Read the mesh from the Gmsh file at @p path. Throws InputError if that fails or if
   *  the mesh leaves the box of @p grid. Collective. */
  SealMesh
  read_seal_mesh(const std::string &path, const PeriodicGrid &grid, MPI_Comm comm);

  /**
   * Find out whether @p mesh is a strip or a ring, and set what follows: its edges, one
   * closed boundary after the other, and which wall is which, or where the hole is. The
   * boundary @p edges are given by their first points; inlet and outlet are known. Throws
   * InputError if it is neither; @p name stands for the mesh in the message.
   */
  void recognise_shape(SealMesh                                     &mesh,
                       const std::map<unsigned int, SealMesh::Edge> &edges,
                       const std::string                            &name);

  /** Return the circle through all of @p points, to a millionth of its radius; nothing if
   *  there is none, if they lie on a straight line, or if they are fewer than three. */
  std::optional<SealMesh::Circle> fit_circle(const std::vector<dealii::Point<2>> &points);
} // namespace strait
