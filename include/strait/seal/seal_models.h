// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/contact/contact_model.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/seal_state.h>

#include <memory>

namespace strait
{
  /**
   * A seal whose contact and flow agree with each other: the fluid presses the walls
   * apart, and the gap decides where the fluid goes. Contact is the dry problem for the
   * wall that the fluid's pressure (FluidOnWall) has displaced, under the load that it
   * leaves; the pressure of @p contact is that of the solid beyond the fluid's.
   *
   * For a leak rate, contact and flow agree on finer and finer meshes, until what the
   * last mesh changed and the width of a bracket on it are together as small as the
   * accuracy that is asked for. The references must outlive the model.
   */
  SealModel coupled_seal(const Scene                  &scene,
                         std::shared_ptr<ContactModel> contact,
                         const SlabLayoutPtr          &layout,
                         FlowStage                    &flow,
                         Log                          &log);

  /**
   * A @p seal whose throats are resolved: where a channel percolates, the state gets
   * the windows that its throats lack, one level after the other, and is solved again.
   * Where none does, so does the barrier where it is weakest, for on finer points it may
   * be open. For a leak rate half of the digits are enough while windows are sought, the
   * state that is returned has all of them. The state keeps those of the state that it
   * came from, so that neighbouring states have the same points. The reference must
   * outlive the model.
   */
  SealModel zoomed_seal(SealModel             seal,
                        const ZoomParameters &zoom,
                        FlowDirection         direction,
                        Log                  &log);

  /**
   * How much smaller than the target accuracy the width of the bracket is on the first
   * mesh, and how much on each mesh than on the one before: the gap amplifies the errors
   * of the fluid's pressure, the more so the closer it is to the threshold. Half of it
   * makes each mesh larger, double of it takes more meshes.
   */
  constexpr double mesh_fraction = .25;
} // namespace strait
