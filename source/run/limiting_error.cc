// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/simulation.h>
#include <strait/run/step.h>
#include <strait/surface/read_scene.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace strait
{
  namespace
  {
    /** What is known of the last throat on surfaces of one kind. */
    struct ThroatLaw
    {
      double critical_load; // over ContactParameters::pressure_scale()
      double points;        // grid points along it, over (1 − L/L_c)^0.58
    };

    /** Return nothing for surfaces of other kinds. */
    std::optional<ThroatLaw>
    throat_law(const Scene &scene)
    {
      const PeriodicGrid grid    = grid_of(scene);
      const double       spacing = std::max(grid.dx(), grid.dy());
      // Both numbers are results of runs.
      if (scene.surface.kind == SurfaceKind::square_saddle)
        return ThroatLaw{.228605, .212 * scene.surface.size[0] / spacing};
      // About the least of random critical loads, whose mean is 0.24: to be surprised by
      // the threshold is worse than to be warned of it. Half and double of it would warn
      // of nearly all loads, or of none.
      if (scene.surface.kind == SurfaceKind::self_affine)
        return ThroatLaw{.19, .65 * scene.surface.short_cut_off_wavelength / spacing};
      return {};
    }

    /** Return the smallest reduced load of the run: of the Reduced loads of the scene or,
     *  without these, of the Pressures below the @p critical load. Return nothing if all
     *  loads seal. */
    std::optional<double>
    smallest_reduced_load(const Scene &scene, const double critical)
    {
      const std::vector<double> &asked = scene.programme.reduced_loads;
      if (!asked.empty())
        return *std::min_element(asked.begin(), asked.end());
      std::optional<double> smallest;
      if (scene.contact.is_load_controlled())
        for (const double pressure : scene.programme.pressures)
          if (const double reduced = 1. - pressure / critical; reduced > 0)
            smallest = std::min(smallest.value_or(reduced), reduced);
      return smallest;
    }
  } // namespace

  std::string
  limiting_error(const Scene &scene, const double rms_slope)
  {
    if (scene.contact.zoom.enabled)
      {
        // Nearer to the critical load the contact on the grid changes by a few points
        // only; doc/zoom.md compares grids. Half of it trusts rows that miss their error.
        constexpr double points_nearest = 16.;
        return format(
          "windows follow the throat, so the largest error is not predicted: see "
          "leak_rate_error; reduced loads below about %.2g are beyond this grid of the "
          "contact, however fine the windows",
          points_nearest / static_cast<double>(grid_of(scene).n_points()));
      }
    const std::optional<ThroatLaw> law = throat_law(scene);
    const std::optional<double>    reduced =
      law ? smallest_reduced_load(scene,
                                  law->critical_load *
                                    scene.contact.pressure_scale(rms_slope))
             : std::nullopt;
    if (!reduced)
      return "largest error: not predicted for this surface and these loads; "
             "Output/Error budget tells";
    const double      points = law->points * std::pow(*reduced, .58);
    const std::string throat =
      format("about %.2g grid points along the throat at a reduced load of %.2g%s, ",
             points,
             *reduced,
             scene.surface.kind == SurfaceKind::self_affine &&
                 scene.programme.reduced_loads.empty()
               ? " (if such a seal closes early)"
               : "");
    if (points < least_points_along_throat)
      {
        const auto enough = [&](const int n) {
          return std::ceil(n * least_points_along_throat / points);
        };
        return throat +
               format(
                 "so the contact grid is likely to be the largest error (a per cent "
                 "and more): Contact/Grid points = %.0f, %.0f or more would reduce it",
                 enough(scene.contact.grid_points[0]),
                 enough(scene.contact.grid_points[1]));
      }
    return throat + format(
                      "so the mesh is likely to be the largest error (± %.2g %%): "
                      "Fluid/Target accuracy would reduce it",
                      50. * scene.fluid.target_accuracy);
  }
} // namespace strait
