// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_seal_mesh_h
#define strait_flow_seal_mesh_h

#include <strait/flow/mesh_file.h>
#include <strait/flow/seal_shape.h>

#include <string>

namespace strait
{
  /**
   * The mesh of a Gmsh file; @p name stands for it in messages. Throws InputError, the
   * same on all ranks, where a cell is not convex, or the boundary is neither a strip's
   * nor a ring's.
   */
  SealMesh make_seal_mesh(const MeshFile &file, const std::string &name);

  /** Read the Gmsh file at @p path, which must lie in the box of @p grid. Collective. */
  SealMesh
  read_seal_mesh(const std::string &path, const PeriodicGrid &grid, MPI_Comm comm);
} // namespace strait

#endif
