// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/spectral/periodic_grid.h>

namespace strait
{
  /**
   * Read the scene file @p path, apply @p overrides and make the scene. If the surface is
   * a measured map, what the scene leaves empty of Surface/Size, Contact/Grid points and
   * Units/Length is taken from the map, as processed. Collective on MPI_COMM_WORLD;
   * throws InputError on all ranks for a bad scene or map, or if neither states a size.
   */
  Scene read_scene(const std::string &path, const Overrides &overrides = {});

  /** The contact grid that @p scene asks for. */
  PeriodicGrid grid_of(const Scene &scene);
} // namespace strait
