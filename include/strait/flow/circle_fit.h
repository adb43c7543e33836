// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_circle_fit_h
#define strait_flow_circle_fit_h

#include <strait/flow/seal_mesh.h>

#include <optional>
#include <vector>

namespace strait
{
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
