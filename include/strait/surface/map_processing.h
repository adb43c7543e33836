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
  /** What is to be said of a map: one sentence each. */
  struct Remarks
  {
    std::vector<std::string> notes;
    std::vector<std::string> warnings;
  };

  /**
   * Give heights and size in the scene's unit of length. What the scene says of
   * the file's units prevails over what the file says; a file without any unit is
   * in the scene's. Throws InputError, naming the parameter that settles it, if a
   * unit is no length, or one of heights and size has a unit and the other none.
   * @return whether the heights have one.
   */
  bool convert_to_scene_units(HeightMap &map, const MapParameters &parameters);

  /** Subtract mean, plane or paraboloid of least squares over the valid points. */
  void detrend(HeightMap &map, Detrend what);

  /**
   * Fill missing points with the harmonic function of the points around them, by the
   * sides of @p map, which must be known.
   * Throws InputError if they are more than @p largest_share of all.
   */
  void fill_missing_points(HeightMap &map, double largest_share, Remarks &remarks);

  /**
   * Make one period of @p map as the scene says, and warn of what that does to
   * rms height and slope; with MakePeriodic::no warn of a step at the seam. Its sides
   * must be known.
   */
  void make_periodic(HeightMap &map, const MapParameters &parameters, Remarks &remarks);

  /**
   * Keep of @p map the window of @p parameters, with the points that it has in the file.
   * Rows and columns that are left over where the windows do not divide the map belong to
   * none. Throws InputError if there is no such window, or no point in it.
   */
  void cut_window(HeightMap &map, const SurfaceParameters &parameters);

  /** A map on another grid, and what it lost. */
  struct Resampled
  {
    std::vector<double> values;           // row by row
    double              kept_height = 1.; // rms height over that of the source
    double              kept_slope  = 1.; // rms slope over that of the source
  };

  /**
   * The trigonometric interpolant of @p values on the grid @p source, at the points
   * of the grid @p target on the same box, without the waves that the target cannot
   * carry or that are shorter or longer than asked for (0: no limit; circular limits;
   * the mean stays). Exact where the target carries all waves. Not collective.
   */
  Resampled fourier_resample(const std::vector<double> &values,
                             const PeriodicGrid        &source,
                             const PeriodicGrid        &target,
                             double                     shortest = 0.,
                             double                     longest  = 0.);

  /**
   * A measured map from @p file on the grid of @p layout, after all of the above as far
   * as the scene asks for it: row 0 of the file is y = 0. Rank 0 reads and processes it,
   * and adds to @p remarks. Collective. Throws InputError for a bad file, where the file
   * states a size that differs from the scene's by more than a thousandth, and unless the
   * scene resamples where the grid is not that of the map, or where its heights have a
   * unit and those of a map before had none, or the other way round: @p have_unit tells
   * that from one call to the next, on rank 0.
   */
  SlabField heights_of_map(const SurfaceParameters &parameters,
                           const std::string       &file,
                           const SlabLayoutPtr     &layout,
                           std::optional<bool>     &have_unit,
                           Remarks                 &remarks);
} // namespace strait
