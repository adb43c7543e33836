// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>

namespace strait
{
  namespace
  {
    void
    check_size(const HeightMap &map, const SurfaceParameters &parameters)
    {
      for (int d = 0; d < 2; ++d)
        if (std::abs(parameters.size[d] / (*map.size)[d] - 1) > 1e-3)
          reject_height_map(
            map.file,
            "is, processed, of a size other than the scene's: set "
            "Surface/Size = " +
              scene_pair(parameters, (*map.size)[0], (*map.size)[1]) +
              " in the scene's unit of length (metres unless Units/Length "
              "says otherwise).");
    }

    /** Resample a processed map, or make sure that its grid is @p grid already. */
    void
    bring_to_grid(HeightMap               &map,
                  const SurfaceParameters &parameters,
                  const PeriodicGrid      &grid,
                  Remarks                 &remarks)
    {
      const double shortest = parameters.map.shortest_wavelength;
      const double longest  = parameters.map.longest_wavelength;
      const bool   is_same  = grid.nx == map.nx && grid.ny == map.ny;
      if (!is_same && !parameters.map.resample)
        reject_height_map(map.file,
                          "has, processed, " + std::to_string(map.nx) + " x " +
                            std::to_string(map.ny) +
                            " points, and the grid must have as many: set "
                            "Surface/Resample = true or Contact/Grid points = " +
                            scene_pair(parameters, map.nx, map.ny) + ".");
      if (is_same && shortest == 0. && longest == 0.)
        return;
      Resampled result = fourier_resample(
        map.values, {map.nx, map.ny, grid.lx, grid.ly}, grid, shortest, longest);
      remarks.notes.push_back(
        format("on the grid the map keeps %.4g %% of its rms height and %.4g %% of "
               "its rms slope",
               100 * result.kept_height,
               100 * result.kept_slope));
      map.values = std::move(result.values);
    }

    using Complex = std::complex<double>;

    /**
     * The fraction of wave number @p k, on @p n points, that a grid of @p n_target points
     * carries. The wave at the end of a spectrum stands for two, ±k: a finer grid has
     * both of them, and a coarser one would fold both together.
     */
    double
    fraction_of_wave(const int k, const int n, const int n_target)
    {
      const int twice = 2 * std::abs(k);
      if (twice > n || (twice == n_target && n_target < n))
        return 0.;
      return twice == n && n_target > n ? .5 : 1.;
    }

    /** Warn if the points of a map without a size are spaced differently along x and y:
     *  the scene's size may be meant for the map before it was turned or cut. */
    void
    warn_of_long_cells(const HeightMap         &map,
                       const SurfaceParameters &parameters,
                       Remarks                 &remarks)
    {
      const double dx = (*map.size)[0] / map.nx, dy = (*map.size)[1] / map.ny;
      // Sides that are stated to three digits make cells that are square to about that.
      if (std::abs(dx / dy - 1) <= 1e-2)
        return;
      const double spacing =
        std::max(parameters.size[0], parameters.size[1]) / std::max(map.nx, map.ny);
      remarks.warnings.push_back(format(
        "the map '%s' states no size: by Surface/Size, which is that of the surface "
        "in the scene, turned and cut, its points are %.4g apart along x and %.4g "
        "along y; if it is the same both ways, set Surface/Size = %s",
        map.file.c_str(),
        dx,
        dy,
        scene_pair(parameters, spacing * map.nx, spacing * map.ny).c_str()));
    }
  } // namespace

  Resampled
  fourier_resample(const std::vector<double> &values,
                   const PeriodicGrid        &source,
                   const PeriodicGrid        &target,
                   const double               shortest,
                   const double               longest)
  {
    // A wave of exactly the limiting length is kept.
    const double q_most  = shortest > 0 ? 2 * M_PI / shortest * (1 + rounding) : HUGE_VAL;
    const double q_least = longest > 0 ? 2 * M_PI / longest * (1 - rounding) : 0.;

    std::vector<Complex> modes(static_cast<std::size_t>(source.nx / 2 + 1) * source.ny);
    const auto           mode_at = [&](const int kx, const int ky) -> Complex           &{
      return modes[static_cast<std::size_t>((ky + source.ny) % source.ny) *
                     (source.nx / 2 + 1) +
                   kx];
    };
    FourierTransform(make_layout(source, MPI_COMM_SELF))
      .analyze(values.data(),
               [&](const int kx, const int ky, const Complex &mode, double) {
                 mode_at(kx, ky) = mode;
               });
    Resampled result;
    result.values.resize(static_cast<std::size_t>(target.n_points()));
    FourierTransform(make_layout(target, MPI_COMM_SELF))
      .synthesize(result.values.data(), [&](const int kx, const int ky) -> Complex {
        const double q        = 2 * M_PI * std::hypot(kx / source.lx, ky / source.ly);
        const double fraction = fraction_of_wave(kx, source.nx, target.nx) *
                                fraction_of_wave(ky, source.ny, target.ny);
        const bool is_in_band = q == 0. || (q <= q_most && q >= q_least);
        return fraction > 0. && is_in_band ? fraction * mode_at(kx, ky) : 0.;
      });
    const auto statistics_of = [](const PeriodicGrid        &grid,
                                  const std::vector<double> &map) {
      return statistics(scatter_from_root(make_layout(grid, MPI_COMM_SELF), map));
    };
    const SurfaceStatistics before = statistics_of(source, values);
    const SurfaceStatistics after  = statistics_of(target, result.values);
    if (before.rms_height > 0)
      {
        result.kept_height = after.rms_height / before.rms_height;
        result.kept_slope  = after.rms_slope / before.rms_slope;
      }
    return result;
  }

  SlabField
  heights_of_map(const SurfaceParameters &parameters,
                 const std::string       &file,
                 const SlabLayoutPtr     &layout,
                 std::optional<bool>     &have_unit,
                 Remarks                 &remarks)
  {
    HeightMap map;
    run_on_root(layout->communicator(), [&]() {
      map = read_height_map(file);
      cut_window(map, parameters);
      remarks.notes.push_back(format("map '%s': %s, %d × %d points",
                                     file.c_str(),
                                     map.format.c_str(),
                                     map.nx,
                                     map.ny));
      const bool has_unit = convert_to_scene_units(map, parameters.map);
      if (has_unit != have_unit.value_or(has_unit))
        reject_height_map(map.file,
                          std::string(has_unit ? "states" : "does not state") +
                            " the unit of its heights, unlike the first map: set "
                            "Surface/Height unit, which is that of both.");
      have_unit              = has_unit;
      const bool states_size = map.size.has_value();
      if (!states_size)
        {
          // The scene's size is that of the map after it is mirrored.
          const double n = parameters.map.make_periodic == MakePeriodic::mirror ? 2. : 1.;
          map.size       = {{parameters.size[0] / n, parameters.size[1] / n}};
          warn_of_long_cells(map, parameters, remarks);
        }
      detrend(map, parameters.map.detrend);
      fill_missing_points(map, parameters.map.largest_missing_share, remarks);
      make_periodic(map, parameters.map, remarks);
      if (states_size)
        check_size(map, parameters);
      bring_to_grid(map, parameters, layout->grid(), remarks);
    });
    return scatter_from_root(layout, map.values);
  }
} // namespace strait
