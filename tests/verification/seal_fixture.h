// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_tests_seal_fixture_h
#define strait_tests_seal_fixture_h

#include <string>

#include "flow_fixture.h"

namespace strait
{
  inline std::string
  mesh_path(const std::string &name)
  {
    return std::string(STRAIT_TEST_DATA) + "/../meshes/" + name + ".msh";
  }

  /** A gap around a mesh of the project, taken through percolation and bridge. */
  struct GapInSeal
  {
    GapInSeal(const SlabField &gap, FluidParameters fluid, const std::string &mesh)
      : seal(read_seal_mesh(mesh_path(mesh), gap.grid(), MPI_COMM_WORLD))
      , domain(std::make_shared<const FlowRegion>(gap.grid(),
                                                  seal.outline(.25 * gap.grid().dx()),
                                                  MPI_COMM_WORLD))
      , clusters(find_clusters(gap, domain))
      , field(gap.layout_pointer(), with_mesh(fluid, mesh))
    {
      const SlabField kept = percolating_gap(gap, clusters, domain);
      paths                = find_flow_paths(kept, domain, 3);
      const double bottleneck =
        paths.empty() ? 1. : field.conductivity_of(paths.front().bottleneck_gap);
      field.update(kept, 1e-8 * bottleneck);
    }

    static FluidParameters
    with_mesh(FluidParameters fluid, const std::string &mesh)
    {
      fluid.mesh_file = mesh_path(mesh);
      return fluid;
    }

    SealMesh              seal;
    FlowDomain            domain;
    Clusters              clusters;
    GapField              field;
    std::vector<FlowPath> paths;
  };

  inline FlowResult
  leak_in_seal(const SlabField                &gap,
               const FluidParameters          &fluid,
               const std::string              &mesh,
               const ReynoldsSolver::Observer &observer = {})
  {
    const GapInSeal given(gap, fluid, mesh);
    ReynoldsSolver  solver(fluid, given.field, given.paths, &given.seal);
    return solver.run(observer);
  }
} // namespace strait

#endif
