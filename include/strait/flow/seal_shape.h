// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_seal_shape_h
#define strait_flow_seal_shape_h

#include <strait/flow/seal_mesh.h>

#include <optional>
#include <string>
#include <vector>

namespace strait
{
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
