// SPDX-License-Identifier: GPL-2.0-or-later
// What the fluid's pressure on the walls leaves uncertain of a leak rate.
#include <strait/seal/coupled_seal.h>

#include <algorithm>

namespace strait
{
  double
  share_of_bracket(const SealState &state, const double target_accuracy)
  {
    return state.fluid
             ? std::max(mesh_share, 1. - 2. * state.fluid->mesh_error / target_accuracy)
             : 1.;
  }

  void
  allow_for_feedback(Leakage          &result,
                     const FluidState &fluid,
                     const double      target_accuracy)
  {
    result.lower *= std::max(0., 1. - fluid.mesh_error);
    result.upper *= 1. + fluid.mesh_error;
    if (fluid.undecided)
      result.lower = 0; // it is closed at times
    else if (result.status == "ok" && result.relative_width() > target_accuracy)
      {
        result.status = "flow-accuracy";
        result.reason = "the fluid's pressure on the wall still changes with the mesh";
      }
  }
} // namespace strait
