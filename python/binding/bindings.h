// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/path.h>
#include <strait/seal/seal_search.h>
#include <strait/seal/seal_state.h>

#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strait::python
{
  namespace py = pybind11;

  /** A scene, and the file and overrides that it was made from. */
  struct SceneSource
  {
    std::string path; // the scene file
    Overrides   overrides;
    Scene       scene;
  };

  /** States are shared with the arrays that show their fields. */
  using State = std::shared_ptr<SealState>;

  /** The flow through one gap, without its mesh. */
  struct Flow
  {
    Leakage                   leakage;
    bool                      percolates    = false;
    double                    effective_gap = 0.;
    SlabLayoutPtr             layout;
    std::vector<std::uint8_t> clusters; // NodeState of each point

    /** The narrowest point of the path of least resistance; not a number without one. */
    double x   = std::numeric_limits<double>::quiet_NaN();
    double y   = std::numeric_limits<double>::quiet_NaN();
    double gap = std::numeric_limits<double>::quiet_NaN();

    /** Pressure and current of the fluid at the points that leak, elsewhere not a number;
     *  only if asked for. The current is leak rate per length. */
    std::optional<SlabField> pressure, current;
  };

  /** The part of @p flow that does not need its mesh, with the clusters on @p grid, which
   *  has no windows. Places in @p flow are those of @p points, which may have windows. */
  std::shared_ptr<Flow> record_of(const StepFlow        &flow,
                                  const SlabLayout      &points,
                                  const SlabLayoutPtr   &grid,
                                  const FluidParameters &fluid);

  /** Set pressure and current of @p flow, which @p solver has found. Collective. */
  void add_fields(Flow &flow, const ReynoldsSolver &solver);

  void bind_scene(py::module_ &module);
  void bind_states(py::module_ &module);
  void bind_seal(py::module_ &module);
} // namespace strait::python
