// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/spectral/periodic_grid.h>

namespace strait
{
  /**
   * Read the scene file @p path, override it and make the scene. What it leaves empty of
   * Surface/Size, Contact/Grid points and Units/Length is the map's own, after
   * processing, if the surface is one. Collective on MPI_COMM_WORLD; throws InputError on
   * all ranks, for a bad scene or a bad map, or if neither of them states a size.
   */
  Scene read_scene(const std::string &path, const Overrides &overrides = {});

  /** The grid that @p scene asks for. */
  PeriodicGrid grid_of(const Scene &scene);
} // namespace strait
