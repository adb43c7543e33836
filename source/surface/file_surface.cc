// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/text.h>
#include <strait/surface/file_surface.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/resample.h>
#include <strait/surface/scene_text.h>

#include <cmath>

namespace strait
{
  namespace
  {
    void
    check_size(const SurfaceParameters     &parameters,
               const std::array<double, 2> &stated,
               const std::string           &file)
    {
      for (int d = 0; d < 2; ++d)
        if (std::abs(parameters.size[d] / stated[d] - 1) > 1e-3)
          reject_height_map(
            file,
            "is, processed, of a size other than the scene's: set "
            "Surface/Size = " +
              scene_pair(parameters, stated[0], stated[1]) +
              " in the scene's unit of length (metres unless Units/Length "
              "says otherwise).");
    }
  } // namespace

  FileSurface::FileSurface(const SurfaceParameters &parameters,
                           const std::string       &file_,
                           MPI_Comm                 communicator)
    : scene(parameters)
    , file(file_)
  {
    run_on_root(communicator, [&]() {
      map = read_height_map({file, scene.map.format, scene.map.dataset});
      process_map(map, scene.map, file, of_map);
      if (map.size)
        check_size(scene, *map.size, file);
    });
    MPI_Bcast(&map.nx, 1, MPI_INT, 0, communicator);
    MPI_Bcast(&map.ny, 1, MPI_INT, 0, communicator);
  }

  SlabField
  FileSurface::heights(const SlabLayoutPtr &layout) const
  {
    const PeriodicGrid &grid = layout->grid();
    if (!scene.map.resample && (grid.nx != map.nx || grid.ny != map.ny))
      reject_height_map(file,
                        "has, processed, " + std::to_string(map.nx) + " x " +
                          std::to_string(map.ny) +
                          " points, and the grid must have as many: set "
                          "Surface/Resample = true or Contact/Grid points = " +
                          scene_pair(scene, map.nx, map.ny) + ".");
    std::vector<double> values;
    run_on_root(layout->communicator(), [&]() { values = values_on(grid); });
    return scatter_from_root(layout, values);
  }

  std::vector<double>
  FileSurface::values_on(const PeriodicGrid &grid) const
  {
    const WaveBand band{scene.map.shortest_wavelength, scene.map.longest_wavelength};
    const bool     is_same = grid.nx == map.nx && grid.ny == map.ny;
    of_grid.clear();
    if (is_same && band.shortest == 0. && band.longest == 0.)
      return map.values;
    Resampled result =
      fourier_resample(map.values, {map.nx, map.ny, grid.lx, grid.ly}, grid, band);
    of_grid = format(
      "on the grid the map keeps %.4g %% of its rms height and %.4g %% of "
      "its rms slope",
      100 * result.kept_height,
      100 * result.kept_slope);
    return std::move(result.values);
  }

  Remarks
  FileSurface::remarks() const
  {
    Remarks all = of_map;
    if (!of_grid.empty())
      all.notes.push_back(of_grid);
    return all;
  }
} // namespace strait
