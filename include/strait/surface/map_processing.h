// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>
#include <strait/surface/readers/height_map.h>

#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** What the user should know of a surface, one sentence each. */
  struct Remarks
  {
    std::vector<std::string> notes;
    std::vector<std::string> warnings;
  };

  /**
   * Convert heights and size to the scene's unit of length. Units that the scene states
   * override those of the file; a file without any unit is in the scene's. Throws
   * InputError, naming the parameter that settles it, if a unit is not a length, if only
   * one of heights and size has a unit, or if the scene states a lateral unit for a
   * single file without a size. @return whether the heights have a unit.
   */
  bool convert_to_scene_units(HeightMap &map, const MapParameters &parameters);

  /** Subtract mean, plane or paraboloid, fitted to the valid points by least squares. */
  void detrend(HeightMap &map, Detrend what);

  /**
   * Fill missing points with the harmonic function of the points around them. The size of
   * @p map, which gives the ratio of the spacings, must be known.
   * Throws InputError if more than @p largest_share of all points are missing.
   */
  void fill_missing_points(HeightMap &map, double largest_share, Remarks &remarks);

  /**
   * Make @p map one period in the way that the scene asks for, and warn of what that does
   * to rms height and slope; with MakePeriodic::no, warn of a large step at the seam. The
   * size of the map must be known.
   */
  void make_periodic(HeightMap &map, const MapParameters &parameters, Remarks &remarks);

  /**
   * Cut @p map down to the window that the scene selects, on the points of the file. Rows
   * and columns that are left over if the windows do not divide the map belong to none of
   * them. Throws InputError if there is no such window, or if it has too few points.
   */
  void cut_window(HeightMap &map, const SurfaceParameters &parameters);

  /** A map on another grid, and the roughness that it keeps there. */
  struct Resampled
  {
    std::vector<double> values;           // row by row
    double              kept_height = 1.; // rms height over that of the source
    double              kept_slope  = 1.; // rms slope over that of the source
  };

  /**
   * Evaluate the trigonometric interpolant of @p values on the grid @p source at the
   * points of the grid @p target on the same box. Waves that the target cannot carry are
   * left out, and so are those shorter than @p shortest or longer than @p longest, in any
   * direction (0: no limit); the mean stays. Exact if all waves are kept. Not collective.
   */
  Resampled fourier_resample(const std::vector<double> &values,
                             const PeriodicGrid        &source,
                             const PeriodicGrid        &target,
                             double                     shortest = 0.,
                             double                     longest  = 0.);

  /**
   * Read a measured map from @p file and bring it to the grid of @p layout, with all of
   * the above that the scene asks for. Row 0 of the file is y = 0. Rank 0 reads and
   * processes the map, and adds to @p remarks. Collective. Throws InputError for a bad
   * file; if the size in the file, as processed, differs from the scene's by more than a
   * thousandth; if the grid is not that of the map and the scene does not resample; and
   * if only one of this and an earlier map has a unit of heights, which @p have_unit
   * carries from call to call on rank 0.
   */
  SlabField heights_of_map(const SurfaceParameters &parameters,
                           const std::string       &file,
                           const SlabLayoutPtr     &layout,
                           std::optional<bool>     &have_unit,
                           Remarks                 &remarks);
} // namespace strait
