// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_simulation_h
#define strait_driver_simulation_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/spectral/periodic_grid.h>

namespace strait
{
  /** The grid that @p scene asks for. */
  PeriodicGrid grid_of(const Scene &scene);

  /**
   * Run @p scene and write its results to the output directory. Collective.
   * Throws InputError before anything is written if the scene's input is bad, and
   * ComputationError at the end, with all results on the disk, if a step did not
   * converge.
   */
  void simulate(const Scene &scene, Log &log);

  /**
   * Check @p scene as simulate() would and print sizes, memory, resolution
   * warnings and active effects; compute nothing but the surface. Collective.
   */
  void describe(const Scene &scene, Log &log);
} // namespace strait

#endif
