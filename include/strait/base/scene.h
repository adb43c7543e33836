// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/base/fluid_parameters.h>
#include <strait/base/run_parameters.h>
#include <strait/base/scene_text.h>
#include <strait/base/surface_parameters.h>
#include <strait/base/units.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace strait
{
  class ParameterTable;

  /** All that a scene file says, parsed and checked; constant from then on. */
  struct Scene
  {
    UnitParameters        units;
    SurfaceParameters     surface;
    ContactParameters     contact;
    FluidParameters       fluid;
    ProgrammeParameters   programme;
    RealisationParameters realisations;
    WholeSealParameters   seal;
    TheoryParameters      theory;
    OutputParameters      output;

    /** Whether the scene asks for the theory and for no simulation. */
    bool
    is_theory_only() const
    {
      return theory.enabled && !contact.enabled && !fluid.enabled;
    }

    /** Whether E* has a physical value, so that slopes and pressures do as well. In
     *  reduced units, with E* = 1 and no unit stated, results depend only on slope × E*
     *  over pressure, and a slope of 1 says nothing. */
    bool
    has_physical_modulus() const
    {
      const bool is_used = contact.enabled || theory.enabled;
      return !units.pressure.empty() || (is_used && contact.effective_modulus != 1.);
    }

    /** Whether the flow through two boxes in a row can be solved once that through one is
     *  known: it must be along x, linear in the pressure, and leave the gap as it is. */
    bool
    can_flow_in_a_row() const
    {
      return fluid.enabled && fluid.direction == FlowDirection::x &&
             fluid.mesh_file.empty() && fluid.rarefaction == Rarefaction::none &&
             !fluid.feedback.enabled && !contact.zoom.enabled;
    }

    /** Whether the flow through two boxes in a row is solved beside that through one:
     *  because the scene asks for it, or because the seal has several patches in a row,
     *  whose ends must count only once. */
    bool
    has_two_boxes() const
    {
      // The number of patches is rounded: below 1.5 there is one.
      const bool is_wide = seal.enabled && seal.contact_width >= 1.5 * surface.size[0];
      return fluid.enabled && (seal.two_in_a_row || (is_wide && can_flow_in_a_row()));
    }

    /** Whether a state depends on the state it was reached from by more than the
     *  tolerance. */
    bool
    depends_on_path() const
    {
      return (contact.enabled && (contact.adhesion.enabled || contact.yields)) ||
             fluid.feedback.enabled;
    }

    /** The entries that the scene was made from. */
    std::vector<SceneEntry> entries;

    /** The scene file, with every default filled in. */
    std::string resolved;

    /** One sentence for each effect that is off although its parameters are set, and for
     *  each number that a scene with units does not give. */
    std::vector<std::string> oversights;

    /** Bind all parameters to @p table; this scene must not move while that is in use. */
    void bind(ParameterTable &table);
    /** Check each section and that they agree; throws InputError. */
    void check() const;
    /** One sentence for each setting that is allowed but doubtful. */
    std::vector<std::string> warnings() const;
  };

  /** An override from the command line, "Section/Parameter=value". */
  using Overrides = std::vector<std::string>;

  /** The scene that @p entries give, not yet checked but for each value by itself. Throws
   *  InputError for an unknown parameter or a value that is not allowed. */
  Scene parse_scene(const std::vector<SceneEntry> &entries);

  /** The scene that @p entries give, checked. Throws InputError for an unknown parameter
   *  (naming file, line and the nearest known name), a value that is not allowed, or
   *  sections that contradict each other. */
  Scene make_scene(const std::vector<SceneEntry> &entries);

  /** The entries of the scene file @p path, which rank 0 of MPI_COMM_WORLD reads,
   *  followed by the overrides, on all ranks; see read_scene(). Collective. Throws
   *  InputError on all ranks, also for an unreadable file. Relative paths start at the
   *  folder of the scene file, those in an override at the current folder. */
  std::vector<SceneEntry> read_entries(const std::string &path,
                                       const Overrides   &overrides);

  /** All parameters with defaults, units and documentation, as a scene file ("prm") or as
   *  tables in Markdown ("md"). Throws InputError for another format. */
  void print_parameters(std::ostream &out, const std::string &format);
} // namespace strait
