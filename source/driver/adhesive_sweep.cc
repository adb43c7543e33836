// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/driver/adhesive_sweep.h>
#include <strait/percolation/bottleneck.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    AdhesionLaw
    reported_law(const ContactParameters &parameters, const SlabField &heights, Log &log)
    {
      if (parameters.adhesion.matched_pressure > 0)
        log.line("adhesion: a surface energy is sought that doubles the contact area");
      const AdhesionScale scale(parameters, heights);
      const AdhesionLaw   law        = adhesion_of_scene(parameters, heights);
      const double        resolution = scale.resolution(law);
      log.line(
        format("adhesion: surface energy %.5g, range %.5g, Tabor number %.4g, E*/(k a) = "
               "%.3g",
               law.surface_energy,
               law.range,
               scale.tabor_number(law),
               resolution));
      if (resolution < resolved_adhesion)
        log.warn(
          format("the range of the adhesion is short for the grid: E*/(k a) with the "
                 "slope k of the attraction is %.3g and should be at least %g, or loads "
                 "of jumps depend on the grid",
                 resolution,
                 resolved_adhesion));
      return law;
    }

    AdhesiveStart
    start_of(const LoadPath path)
    {
      return path == LoadPath::unloading ? AdhesiveStart::full_contact
                                         : AdhesiveStart::without_adhesion;
    }

    /** In units of the load. */
    double
    jump_tolerance(const ProgrammeParameters &programme)
    {
      double largest = 0;
      for (const double target : programme.pressures)
        largest = std::max(largest, std::abs(target));
      return programme.jump_tolerance * largest;
    }
  } // namespace

  AdhesiveSweep::AdhesiveSweep(const Scene             &scene_,
                               const ContactParameters &parameters,
                               SlabField                heights,
                               Log                     &log)
    : scene(scene_)
    , law(reported_law(parameters, heights, log))
    , layout(heights.layout_pointer())
    , solver(parameters, law, start_of(scene.programme.path), std::move(heights))
    , follower(solver, parameters.control, jump_tolerance(scene.programme), log)
  {
  }

  ContactState
  AdhesiveSweep::state_for_search(const double load, const FlowDomain &domain)
  {
    const bool loading = scene.programme.path != LoadPath::unloading;
    const bool usable =
      !search_start.gap.empty() &&
      (loading ? search_start.target <= load : search_start.target >= load);
    if (usable)
      solver.recall(search_start);
    else
      solver.forget();
    ContactState state   = solver.solve(load);
    const bool   is_open = find_bottleneck(state.gap, domain).value > 0;
    if (is_open == loading && state.converged && !state.adhesion->detached)
      search_start = solver.memory();
    return state;
  }

  void
  AdhesiveSweep::transfer(StateArchive &archive)
  {
    follower.transfer(archive);
    archive.field(search_start.gap, layout);
    archive.value(search_start.target);
  }
} // namespace strait
