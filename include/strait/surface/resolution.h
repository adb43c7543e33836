// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_resolution_h
#define strait_surface_resolution_h

#include <strait/base/scene.h>
#include <strait/spectral/periodic_grid.h>

#include <string>
#include <vector>

namespace strait
{
  /** The grid that @p scene asks for. */
  PeriodicGrid grid_of(const Scene &scene);

  /**
   * Whether @p grid carries the shortest waves of a self-affine surface; other
   * kinds pass. Fewer than two grid points a short cut-off wavelength throw an
   * InputError, fewer than four give a warning.
   * @return warnings for the user, one sentence each.
   */
  std::vector<std::string> check_resolution(const SurfaceParameters &parameters,
                                            const PeriodicGrid      &grid);
} // namespace strait

#endif
