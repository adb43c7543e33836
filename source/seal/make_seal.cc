// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/iteration.h>
#include <strait/base/text.h>
#include <strait/base/timers.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/contact/contact_solver.h>
#include <strait/seal/make_seal.h>
#include <strait/seal/seal_models.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** A gap that is given, below zero where closed, and never changes. */
    SealModel
    given_gap(SlabField gap)
    {
      const double mean_gap =
        mean_of(gap, [](const double value) { return std::max(value, 0.); });
      return
        [gap = std::move(gap), mean_gap](const Control &control, const SealState *, Aim) {
          SealState state;
          state.control   = control;
          state.given_gap = gap;
          state.mean_gap  = mean_gap;
          return state;
        };
    }

    /** A contact, with or without adhesion, on whose walls no fluid presses. */
    SealModel
    dry_seal(std::shared_ptr<ContactModel> contact)
    {
      return [contact = std::move(
                contact)](const Control &control, const SealState *from, const Aim aim) {
        const auto start = Timers::Clock::now();
        SealState  state;
        state.control  = control;
        state.contact  = contact->solve(control.target,
                                       from == nullptr ? nullptr : &*from->contact,
                                       nullptr,
                                       aim == Aim::throats ? Digits::half : Digits::all);
        state.mean_gap = state.contact->mean_gap;
        state.costs    = {state.contact->iterations,
                          state.contact->fft_pairs,
                          0,
                          Timers::seconds_since(start)};
        return state;
      };
    }

    /** Find the law of the adhesion and report it. Returns its surface energy. */
    double
    find_surface_energy(const ContactParameters &parameters,
                        const SlabField         &heights,
                        Log                     &log)
    {
      if (parameters.adhesion.matched_pressure > 0)
        log.line("adhesion: a surface energy is sought that doubles the contact area");
      const auto [law, tabor_number, resolution, growth] =
        adhesion_of_scene(parameters, heights);
      log.line(
        format("adhesion: surface energy %.5g, range %.5g, Tabor number %.4g, E*/(k a) = "
               "%.3g",
               law.surface_energy,
               law.range,
               tabor_number,
               resolution));
      if (resolution < resolved_adhesion)
        log.warn(
          format("the range of the adhesion is short for the grid: E*/(k a) with the "
                 "slope k of the attraction is %.3g and should be at least %g, or loads "
                 "of jumps depend on the grid",
                 resolution,
                 resolved_adhesion));
      if (growth < 1.99)
        log.warn(format(
          "no surface energy doubles the contact area at a pressure of %.6g, for it jumps "
          "over that: with this one it is %.3g times as large, and jumps from there",
          parameters.adhesion.matched_pressure,
          growth));
      return law.surface_energy;
    }

    std::unique_ptr<ContactModel>
    make_contact(const Scene &scene, const ContactParameters &contact, SlabField heights)
    {
      if (!contact.adhesion.enabled)
        return std::make_unique<ContactSolver>(contact, std::move(heights));
      const AdhesionLaw law = adhesion_of_scene(contact, heights).law;
      return std::make_unique<AdhesiveContactSolver>(contact,
                                                     law,
                                                     scene.programme.path,
                                                     std::move(heights));
    }
  } // namespace

  ContactParameters
  complete_contact(const Scene     &scene,
                   const SlabField &heights,
                   const double     surface_energy,
                   Log             &log)
  {
    ContactParameters parameters = scene.contact;
    if (scene.programme.find_threshold || scene.programme.find_blow_out)
      // The verdict must not depend on the residual that the solver leaves.
      parameters.tolerance =
        std::min(parameters.tolerance,
                 intermediate_tolerance_factor * scene.programme.threshold_tolerance);
    if (!scene.contact.enabled || !scene.contact.adhesion.enabled)
      return parameters;
    const auto know = [&](const double energy) {
      parameters.adhesion.surface_energy   = energy;
      parameters.adhesion.matched_pressure = 0.;
    };
    if (surface_energy > 0.)
      know(surface_energy);
    know(find_surface_energy(parameters, heights, log));
    return parameters;
  }

  SealModel
  make_seal(const Scene             &scene,
            const ContactParameters &contact,
            SlabField                heights,
            FlowStage               *flow,
            Log                     &log)
  {
    if (!scene.contact.enabled)
      return given_gap(std::move(heights));
    const SlabLayoutPtr           layout = heights.layout_pointer();
    std::shared_ptr<ContactModel> model =
      make_contact(scene, contact, std::move(heights));
    SealModel seal = scene.fluid.feedback.enabled
                       ? coupled_seal(scene, std::move(model), layout, *flow, log)
                       : dry_seal(std::move(model));
    return contact.zoom.enabled
             ? zoomed_seal(std::move(seal), contact.zoom, scene.fluid.direction, log)
             : seal;
  }

  SearchStart
  search_start(const Scene             &scene,
               const ContactParameters &contact,
               const double             rms_slope)
  {
    if (!(rms_slope > 0))
      throw ComputationError(
        "The threshold was not found: a surface without slope seals under every load.");
    const bool unloads = scene.programme.path == LoadPath::unloading;
    if (contact.yields && unloads)
      {
        const double largest = scene.programme.pressures.front();
        return {largest, .2, largest};
      }
    // Rough surfaces seal at 0.24 ± 0.03 E* times their rms slope, the square saddle at
    // 0.229: start a little to the side that the path comes from.
    SearchStart start{(unloads ? .28 : .2) * contact.pressure_scale(rms_slope)};
    if (contact.yields)
      start.end = contact.hardness;
    return start;
  }

  StepRule
  step_rule(const Scene &scene, const double largest)
  {
    return {scene.contact.control,
            scene.programme.jump_tolerance * largest,
            intermediate_tolerance_factor * scene.fluid.target_accuracy};
  }
} // namespace strait
