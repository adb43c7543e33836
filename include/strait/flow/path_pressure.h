// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_path_pressure_h
#define strait_flow_path_pressure_h

#include <strait/flow/reynolds_solver.h>

#include <vector>

namespace strait
{
  /**
   * The fluid's pressure, 1 at the inlet and 0 at the outlet, at the points of
   * @p path. Collective; the result is the same on all ranks.
   */
  std::vector<double> pressure_along(const ReynoldsSolver &solver, const FlowPath &path);
} // namespace strait

#endif
