// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/iteration.h>
#include <strait/base/text.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/contact/contact_solver.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace strait
{
  namespace
  {
    // Smallest resolution without an error. Half of it admits runs whose contact lines
    // stick to the grid; double of it refuses runs that are coarse but usable.
    constexpr double unresolved_adhesion = .8;

    // Relative tolerance of the matched contact area. Half of it costs and double of it
    // saves about one contact problem, and changes the surface energy by as small a part.
    constexpr double area_tolerance = 1e-3;

    /** A surface energy and its contact area, over the contact area without adhesion. */
    struct Match
    {
      double surface_energy;
      double growth;
    };

    /** Find the γ0 at which the contact area doubles; see adhesion_of_scene(). */
    Match
    match_area(const ContactParameters                  &scene,
               const std::function<AdhesionLaw(double)> &law_of,
               const SlabField                          &heights)
    {
      ContactParameters parameters         = scene;
      parameters.control                   = ContactControl::load;
      parameters.tolerance                 = std::max(1e-6, scene.tolerance);
      parameters.adhesion.write_relaxation = false;
      const double       pressure          = scene.adhesion.matched_pressure;
      const ContactState without = ContactSolver(parameters, heights).solve(pressure);
      const double       wanted  = 2 * without.contact_area;
      if (wanted >= 1)
        throw InputError("Contact/Adhesion/Match area at pressure is " +
                         to_text(pressure) + ", where " + format("%.3g", 50 * wanted) +
                         " % are in contact without adhesion; twice that is more than "
                         "all, so give a smaller pressure.");

      const auto excess = [&](const double surface_energy) {
        AdhesiveContactSolver solver(parameters,
                                     law_of(surface_energy),
                                     LoadPath::loading,
                                     heights);
        return solver.solve(pressure, &without).contact_area / wanted - 1;
      };
      // The area grows with γ0, with jumps. First enclose the solution; then take two
      // secant steps between the ends and one bisection of the logarithm, in turns.
      double low = 0, high = 0, below = -.5, above = 0;
      double energy = pressure * without.mean_gap;
      for (int k = 0; k < iteration_limit; ++k)
        {
          const double value = excess(energy);
          if (std::abs(value) < area_tolerance)
            return {energy, 2 * (1 + value)};
          (value < 0 ? low : high)    = energy;
          (value < 0 ? below : above) = value;
          if (high == 0 || low == 0)
            energy *= high == 0 ? 2. : .5;
          else if (high < low * (1 + area_tolerance))
            {
              // The area jumps past the doubled one. Still closer to the jump, rounding
              // would decide on which side of it the run begins.
              energy = low / (1 + area_tolerance);
              return {energy, 2 * (1 + excess(energy))};
            }
          else
            energy = k % 3 == 2 ? std::sqrt(low * high)
                                : low + (high - low) * below / (below - above);
        }
      throw ComputationError(
        "No surface energy was found that doubles the contact area at the pressure " +
        to_text(pressure) + "; give Contact/Adhesion/Surface energy instead.");
    }
  } // namespace

  SceneAdhesion
  adhesion_of_scene(const ContactParameters &parameters, const SlabField &heights)
  {
    const AdhesionParameters &adhesion = parameters.adhesion;
    const double              modulus  = parameters.effective_modulus;
    // The spectrum of a periodic sphere is mostly that of the edge where periods meet.
    const double curvature_radius = adhesion.sphere_radius > 0
                                      ? adhesion.sphere_radius
                                      : statistics(heights).curvature_radius;
    if (adhesion.tabor_number > 0 && !std::isfinite(curvature_radius))
      throw InputError(
        "Contact/Adhesion/Tabor number says nothing about a flat surface; give Range.");
    // The range at which the Tabor number is 1.
    const auto unit_range = [=](const double surface_energy) {
      return std::cbrt(curvature_radius * std::pow(surface_energy / modulus, 2));
    };
    const auto law_of = [&](const double surface_energy) -> AdhesionLaw {
      return {surface_energy,
              adhesion.range > 0 ? adhesion.range
                                 : unit_range(surface_energy) / adhesion.tabor_number,
              adhesion.shape};
    };
    const bool        is_matched = adhesion.matched_pressure > 0;
    const Match       match      = is_matched ? match_area(parameters, law_of, heights)
                                              : Match{adhesion.surface_energy, 2.};
    const AdhesionLaw law        = law_of(match.surface_energy);
    const double      spacing    = std::max(heights.grid().dx(), heights.grid().dy());
    const double      resolution = -modulus / (law.at(0).curvature * spacing);
    if (resolution < unresolved_adhesion && !adhesion.accept_unresolved)
      throw InputError(format(
        "The range of the adhesion, z0 = %.4g, is too short for the grid: E*/(k a) "
        "with the slope k of the attraction is %.3g and should be 3, at least 0.8; "
        "use a grid finer by a factor of %.2g or set Contact/Adhesion/Accept "
        "unresolved range.",
        law.range,
        resolution,
        resolved_adhesion / resolution));
    return {law, unit_range(law.surface_energy) / law.range, resolution, match.growth};
  }
} // namespace strait
