// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/resolution.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  PeriodicGrid
  grid_of(const Scene &scene)
  {
    return {scene.contact.grid_points[0],
            scene.contact.grid_points[1],
            scene.surface.size[0],
            scene.surface.size[1]};
  }

  std::vector<std::string>
  check_resolution(const SurfaceParameters &parameters, const PeriodicGrid &grid)
  {
    if (parameters.kind != SurfaceKind::self_affine)
      return {};
    const double wavelength = parameters.short_cut_off_wavelength;
    const double n_points   = wavelength / std::max(grid.dx(), grid.dy());
    // Four points are four points, however Size was rounded.
    const auto fewer_than = [n_points](const int n) { return n_points < n * (1 - 1e-9); };

    const std::string finding =
      "Surface/Short cut-off wavelength = " + scene_number(wavelength) + " spans only " +
      scene_number(std::round(100 * n_points) / 100) + " grid points";
    const auto remedy = [&](const int n) {
      return "set Contact/Grid points = " +
             scene_number(std::ceil(n * grid.lx / wavelength - 1e-9)) + ", " +
             scene_number(std::ceil(n * grid.ly / wavelength - 1e-9)) +
             " or more, or a longer wavelength.";
    };
    if (fewer_than(2))
      throw InputError(finding + ", and two are needed at the least: " + remedy(2));
    if (fewer_than(4))
      return {finding + ", too few for trustworthy contact and flow: " + remedy(4)};
    return {};
  }
} // namespace strait
