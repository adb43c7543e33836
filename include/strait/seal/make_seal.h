// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/path.h>
#include <strait/seal/seal_state.h>
#include <strait/seal/transition_search.h>

namespace strait
{
  /**
   * Return the contact parameters of the scene with all that a run has to find first: a
   * tolerance that does not affect the verdict of a threshold search, and the surface
   * energy of the adhesion, which is @p surface_energy where that is positive. The
   * adhesion is reported to @p log. Collective. Throws as adhesion_of_scene().
   */
  ContactParameters complete_contact(const Scene     &scene,
                                     const SlabField &heights,
                                     double           surface_energy,
                                     Log             &log);

  /**
   * Make the seal of @p scene; no other place knows all models. @p contact is the
   * completed section of the scene; @p flow is needed where the fluid presses on the
   * walls, and may be null elsewhere. Collective. The references must outlive the model.
   */
  SealModel make_seal(const Scene             &scene,
                      const ContactParameters &contact,
                      SlabField                heights,
                      FlowStage               *flow,
                      Log                     &log);

  /** Return where the search for the first critical load of a surface of this slope
   *  begins, with @p contact in place of that of @p scene. Throws ComputationError if the
   *  slope is not positive. */
  SearchStart
  search_start(const Scene &scene, const ContactParameters &contact, double rms_slope);

  /** Return which steps are too long for the accuracy that the scene asks for, on a path
   *  on which no target has a magnitude above @p largest. */
  StepRule step_rule(const Scene &scene, double largest);
} // namespace strait
