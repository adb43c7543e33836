// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/scene.h>

#include <algorithm>

namespace strait
{
  std::vector<std::string>
  Scene::warnings() const
  {
    std::vector<std::string> warnings = oversights;
    if (surface.kind == SurfaceKind::self_affine &&
        surface.roll_off_wavelength > std::min(surface.size[0], surface.size[1]))
      warnings.emplace_back(
        "Surface/Roll-off wavelength exceeds the shorter side of the box, so the "
        "surface is not isotropic.");
    if (fluid.enabled && fluid.is_gas && fluid.molar_mass == 0.)
      warnings.emplace_back(
        "whether the gas is rarefied is not checked, because neither Fluid/Gas nor Molar "
        "mass is given.");
    const auto ignores = [&](const bool effect, const std::string &name) {
      if (theory.enabled && effect)
        warnings.push_back("the theory knows nothing of " + name +
                           ": its columns are those of a dry contact without adhesion, "
                           "and of viscous flow.");
    };
    ignores(fluid.rarefaction != Rarefaction::none, "Fluid/Rarefaction");
    ignores(fluid.feedback.enabled, "Fluid/Wall feedback");
    ignores(contact.adhesion.enabled, "Contact/Adhesion");
    if (theory.enabled && contact.yields && programme.path != LoadPath::loading)
      warnings.emplace_back(
        "the theory of a contact that yields is that of a first loading; it knows nothing "
        "of the indentations that are left on the way back.");
    if (fluid.is_gas && fluid.feedback.enabled)
      warnings.emplace_back(
        "a gas presses on the walls with its absolute pressure, so the loads count from "
        "a vacuum outside the seal.");
    if (!fluid.enabled && output.error_budget)
      warnings.emplace_back(
        "Output/Error budget is of the leak rate, and Fluid/Enabled = false.");
    if (is_theory_only() && (output.surface_map || output.surface_spectrum))
      warnings.emplace_back(
        "the theory alone writes neither Output/Surface map nor Surface spectrum; switch "
        "Contact or Fluid on to have them.");
    return warnings;
  }
} // namespace strait
