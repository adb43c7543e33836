// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/scene.h>
#include <strait/base/text.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /** Parameters that count only with something else. */
    struct Conditional
    {
      bool                     is_idle;
      std::string              section;
      std::vector<std::string> names; // none: all of the section but its switch
      std::string              needed;
    };

    /** Of these parameters the names of those that are set. */
    std::vector<std::string>
    names_set(const Conditional &these, const std::set<std::string> &changed)
    {
      std::vector<std::string> result;
      for (const std::string &path : changed)
        {
          const std::size_t end  = path.rfind('/');
          const std::string name = path.substr(end + 1);
          const auto       &own  = these.names;
          if (path.substr(0, end) == these.section &&
              (own.empty() ? name != "Enabled"
                           : std::find(own.begin(), own.end(), name) != own.end()))
            result.push_back(name);
        }
      return result;
    }
  } // namespace

  std::vector<std::string>
  Scene::warnings() const
  {
    std::vector<std::string> warnings           = oversights;
    const bool               is_without_flow    = !fluid.enabled && !theory.enabled;
    const bool               is_without_contact = !contact.enabled && !theory.enabled;
    for (const Conditional &these : std::initializer_list<Conditional>{
           {is_without_flow, "Fluid", {}, "Fluid/Enabled = true"},
           {is_without_contact,
            "Contact",
            {"Hardness", "Solver", "Tolerance", "Maximum iterations", "Control"},
            "Contact/Enabled = true"},
           {is_theory_only(),
            "Fluid",
            {"Surface tension",
             "Element degree",
             "Preconditioner",
             "Gap interpolation",
             "Refinement",
             "Target accuracy",
             "Maximum unknowns",
             "Bounds"},
            "Fluid/Enabled = true"},
           {is_theory_only(),
            "Contact",
            {"Solver", "Tolerance", "Maximum iterations"},
            "Contact/Enabled = true"},
           {is_theory_only() && !theory.spectrum_of_surface,
            "Surface",
            {"Seed", "Amplitudes", "Invert", "Rotate"},
            "Theory/Spectrum = surface"},
           {fluid.enabled && fluid.is_gas && fluid.molar_mass == 0.,
            "Fluid",
            {"Temperature"},
            "Fluid/Gas or Molar mass"},
           {!programme.find_threshold && !programme.find_blow_out,
            "Load programme",
            {"Threshold tolerance"},
            "Load programme/Find threshold or Find blow-out"},
           {!contact.adhesion.enabled,
            "Load programme",
            {"Jump tolerance"},
            "Contact/Adhesion/Enabled = true"},
           {!realisations.enabled(),
            "Realisations",
            {"Ranks each"},
            "Realisations/Seeds or Orientations"}})
      if (const auto names = names_set(these, changed); these.is_idle && !names.empty())
        warnings.push_back("without " + these.needed +
                           " these have no effect: " + join(names, ", "));
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
