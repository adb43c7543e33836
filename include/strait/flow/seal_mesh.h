// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /**
   * The coarse mesh on which the fluid flows, with all that follows from its boundary.
   *
   * Boundary id 0 is the inlet, 1 the outlet, the rest are walls. Two shapes are known,
   * in which the stream function has a place to begin and to end:
   * - strip: one closed boundary, of inlet, wall, outlet and wall;
   * - ring: two closed boundaries, one the inlet and the other the outlet.
   *
   * A curve of the geometry on whose boundary edges, two or more, all points lie on a
   * circle is taken to be that circle; edges of other curves are straight.
   */
  struct SealMesh
  {
    /** [length] */
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

    std::vector<dealii::Point<2>>            points;
    std::vector<std::array<unsigned int, 4>> cells; // corners counter-clockwise
    std::vector<Edge>                        edges;
    std::vector<Circle>                      circles;

    bool             is_ring = false;
    dealii::Point<2> pole;                  // of a ring: a point in its hole …
    bool             flows_outwards = true; // … and whether the inlet is around it

    /** The boundary in straight pieces, arcs in ones of at most @p longest. */
    std::vector<OutlineEdge> outline(double longest) const;
  };

  /** What strait takes from a Gmsh file: quadrilaterals and lines between points. */
  struct MeshFile
  {
    /** A line element and where it comes from. */
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
   * Take the @p text of a Gmsh file in ASCII format 4.1 apart; @p name stands for it in
   * messages. Points are numbered anew from 0, those of no element left out. Throws
   * InputError for another format, other elements (single points aside), points off the
   * plane z = 0 and whatever does not make sense.
   */
  MeshFile parse_mesh_file(const std::string &text, const std::string &name);

  /**
   * The mesh of a Gmsh file; @p name stands for it in messages. Throws InputError, the
   * same on all ranks, where a cell is not convex, or the boundary is neither a strip's
   * nor a ring's.
   */
  SealMesh make_seal_mesh(const MeshFile &file, const std::string &name);

  /** Read the Gmsh file at @p path, which must lie in the box of @p grid. Collective. */
  SealMesh
  read_seal_mesh(const std::string &path, const PeriodicGrid &grid, MPI_Comm comm);

  /**
   * Tell from the boundary @p edges of @p mesh, given by their first points, of which
   * inlet and outlet are known, whether it is a strip or a ring, and set what follows:
   * the edges, one closed boundary after the other, which wall is which, or where the
   * hole is. Throws InputError if it is neither; @p name stands for the mesh in the
   * message.
   */
  void recognise_shape(SealMesh                                     &mesh,
                       const std::map<unsigned int, SealMesh::Edge> &edges,
                       const std::string                            &name);

  /** The circle through all of @p points, to a millionth of its radius; none if there is
   *  none, or if they lie on a straight line or are fewer than three. */
  std::optional<SealMesh::Circle> fit_circle(const std::vector<dealii::Point<2>> &points);
} // namespace strait
