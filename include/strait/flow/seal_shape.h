// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_seal_shape_h
#define strait_flow_seal_shape_h

#include <strait/flow/seal_mesh.h>

#include <string>

namespace strait
{
  /**
   * Tell from the boundary edges of @p mesh, of which inlet and outlet are known, whether
   * it is a strip or a ring, and set what follows: which wall is which, or where the hole
   * is. Sorts the edges, one closed boundary after the other. Throws InputError if it is
   * neither; @p name stands for the mesh in the message.
   */
  void recognise_shape(SealMesh &mesh, const std::string &name);
} // namespace strait

#endif
