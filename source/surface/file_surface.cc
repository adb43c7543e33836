// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/surface/file_surface.h>
#include <strait/surface/scene_text.h>

#include <cmath>

namespace strait
{
  namespace
  {
    void
    check_size(const SurfaceParameters &parameters, const std::array<double, 2> &stated)
    {
      for (int d = 0; d < 2; ++d)
        if (std::abs(parameters.size[d] / stated[d] - 1) > 1e-3)
          reject_height_map(parameters.file,
                            "states a size other than the scene's: set Surface/Size = " +
                              scene_pair(parameters, stated[0], stated[1]) +
                              " (in metres).");
    }
  } // namespace

  FileSurface::FileSurface(const SurfaceParameters &parameters, MPI_Comm communicator)
    : scene(parameters)
  {
    run_on_root(communicator, [&]() {
      map = read_height_map(parameters.file);
      if (map.size)
        check_size(parameters, *map.size);
    });
    MPI_Bcast(&map.nx, 1, MPI_INT, 0, communicator);
    MPI_Bcast(&map.ny, 1, MPI_INT, 0, communicator);
  }

  SlabField
  FileSurface::heights(const SlabLayoutPtr &layout) const
  {
    if (layout->grid().nx != map.nx || layout->grid().ny != map.ny)
      reject_height_map(scene.file,
                        "has " + std::to_string(map.nx) + " x " + std::to_string(map.ny) +
                          " points, and the grid must have as many: set Contact/Grid "
                          "points = " +
                          scene_pair(scene, map.nx, map.ny) + ".");
    return scatter_from_root(layout, map.values);
  }
} // namespace strait
