// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_seal_shape_h
#define strait_flow_seal_shape_h

#include <strait/percolation/flow_region.h>

#include <deal.II/base/point.h>

#include <array>
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
    /** Parts of the boundary, in the order of their boundary ids. */
    enum class Part
    {
      inlet,
      outlet,
      right_wall, // seen along the flow
      left_wall
    };

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
      Part         part   = Part::right_wall;
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

  /**
   * Tell from the boundary edges of @p mesh, of which inlet and outlet are known, whether
   * it is a strip or a ring, and set what follows: which wall is which, or where the hole
   * is. Sorts the edges, one closed boundary after the other. Throws InputError if it is
   * neither; @p name stands for the mesh in the message.
   */
  void recognise_shape(SealMesh &mesh, const std::string &name);

  /** The circle through all of @p points, to a millionth of its radius; none if there is
   *  none, or if they lie on a straight line or are fewer than three. */
  std::optional<SealMesh::Circle> fit_circle(const std::vector<dealii::Point<2>> &points);

  /** A chain of points on the arc of @p circle between two points on it, the shorter way,
   *  in steps of at most @p longest; @p from is included, @p to is not. */
  std::vector<dealii::Point<2>> divide_arc(const SealMesh::Circle &circle,
                                           const dealii::Point<2> &from,
                                           const dealii::Point<2> &to,
                                           double                  longest);
} // namespace strait

#endif
