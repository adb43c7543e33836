// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "flow_fixture.h"

namespace strait
{
  inline std::string
  mesh_path(const std::string &name)
  {
    return std::string(STRAIT_TEST_DATA) + "/../meshes/" + name + ".msh";
  }

  /** A seal mesh from the folder meshes, and the part of a grid that lies in it. */
  struct SealOnGrid
  {
    SealOnGrid(const PeriodicGrid &grid, const std::string &mesh)
      : seal(read_seal_mesh(mesh_path(mesh), grid, MPI_COMM_WORLD))
      , domain(std::make_shared<const FlowRegion>(grid,
                                                  seal.outline(.25 * grid.dx()),
                                                  MPI_COMM_WORLD))
    {
    }

    SealMesh   seal;
    FlowDomain domain;
  };

  /** The channel of a gap on a seal mesh and its conductivity, found as the program
   *  does. */
  struct GapInSeal
    : SealOnGrid
    , GivenGap
  {
    GapInSeal(const SlabField &gap, const FluidParameters &fluid, const std::string &mesh)
      : SealOnGrid(gap.grid(), mesh)
      , GivenGap(gap, with_mesh(fluid, mesh), domain)
    {
    }

    static FluidParameters
    with_mesh(FluidParameters fluid, const std::string &mesh)
    {
      fluid.mesh_file = mesh_path(mesh);
      return fluid;
    }
  };

  inline Leakage
  leak_in_seal(const SlabField                &gap,
               const FluidParameters          &fluid,
               const std::string              &mesh,
               const ReynoldsSolver::Observer &observer = {})
  {
    const GapInSeal given(gap, fluid, mesh);
    ReynoldsSolver  solver(fluid, given.field, &given.seal);
    return solver.run(given.channel, observer);
  }
} // namespace strait
