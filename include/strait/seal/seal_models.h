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
   * A seal in which contact and flow agree: the fluid presses the walls apart, and the
   * gap decides where the fluid goes. The contact is the dry problem for the wall that
   * the fluid's pressure (FluidOnWall) has displaced, under the load that the fluid
   * leaves; the pressure of @p contact is what the solid bears beyond the fluid's.
   *
   * For a leak rate, contact and flow agree on finer and finer meshes, until the change
   * by the last mesh and the width of a bracket on it together are as small as the
   * accuracy that is asked for. The references must outlive the model.
   */
  SealModel coupled_seal(const Scene                  &scene,
                         std::shared_ptr<ContactModel> contact,
                         const SlabLayoutPtr          &layout,
                         FlowStage                    &flow,
                         Log                          &log);

  /**
   * A @p seal whose throats are resolved: where a channel percolates, the state gets the
   * windows that its throats lack, level by level, and is solved again. Where none
   * percolates, the weakest place of the barrier is treated alike, because it may be open
   * on finer points. For a leak rate, windows are sought in less accurate states
   * (Aim::throats); the state that is returned has the full accuracy. A state keeps the
   * windows of the one that it is reached from, so that neighbouring states have the same
   * points. The reference must outlive the model.
   */
  SealModel zoomed_seal(SealModel             seal,
                        const ZoomParameters &zoom,
                        FlowDirection         direction,
                        Log                  &log);

  /**
   * Ratio of the bracket's width on the first mesh to the target accuracy, and on each
   * further mesh to that on the one before. It is small because the gap amplifies errors
   * of the fluid's pressure, the more so the closer it is to the threshold. Half of it
   * makes each mesh larger; double of it takes more meshes.
   */
  constexpr double mesh_fraction = .25;
} // namespace strait
