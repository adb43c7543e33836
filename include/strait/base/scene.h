// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_scene_h
#define strait_base_scene_h

#include <strait/base/contact_parameters.h>
#include <strait/base/fluid_parameters.h>
#include <strait/base/output_parameters.h>
#include <strait/base/programme_parameters.h>
#include <strait/base/realisation_parameters.h>
#include <strait/base/surface_parameters.h>
#include <strait/base/theory_parameters.h>
#include <strait/base/unit_parameters.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace strait
{
  /** All that a scene file says, parsed and checked; constant from then on. */
  struct Scene
  {
    UnitParameters        units;
    SurfaceParameters     surface;
    ContactParameters     contact;
    FluidParameters       fluid;
    ProgrammeParameters   programme;
    RealisationParameters realisations;
    TheoryParameters      theory;
    OutputParameters      output;

    /** The scene file, with every default filled in (ParameterHandler text). */
    std::string resolved;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    /** Checks of each section and across sections; throws InputError. */
    void check() const;
    /** What is allowed but doubtful, one sentence each. */
    std::vector<std::string> warnings() const;
  };

  /** An override from the command line, "Section/Parameter=value". */
  using Overrides = std::vector<std::string>;

  /**
   * Read, override and check the scene file @p path on rank 0 of MPI_COMM_WORLD
   * and hand it to all ranks. Throws InputError on all ranks for an unreadable
   * file, an unknown parameter (naming file, line and the nearest known name), a
   * value out of range, or sections that contradict each other. The path in
   * Surface/File becomes absolute: it counts from the folder of the scene file,
   * that of an override from the current folder.
   */
  Scene read_scene(const std::string &path, const Overrides &overrides = {});

  /**
   * All parameters with defaults, units and documentation, as a scene file
   * ("prm") or as tables in Markdown ("md"). Throws InputError for another
   * format.
   */
  void print_parameters(std::ostream &out, const std::string &format);
} // namespace strait

#endif
