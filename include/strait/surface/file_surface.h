// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_file_surface_h
#define strait_surface_file_surface_h

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>
#include <strait/surface/map_processing.h>

namespace strait
{
  /** What of a map's waves a grid is to carry; wavelengths, 0: no limit. */
  struct WaveBand
  {
    double shortest = 0.;
    double longest  = 0.;
  };

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
   * carry or that lie outside @p band (circular limits; the mean stays). Exact where
   * the target carries all waves. Not collective.
   */
  Resampled fourier_resample(const std::vector<double> &values,
                             const PeriodicGrid        &source,
                             const PeriodicGrid        &target,
                             const WaveBand            &band);

  /**
   * A measured map from @p file on the grid of @p layout, processed as the scene says:
   * row 0 of the file is y = 0. Rank 0 reads and processes it, and adds to @p remarks.
   * Collective. Throws InputError for a bad file, where the file states a size that
   * differs from the scene's by more than a thousandth, and unless the scene resamples
   * where the grid is not that of the map.
   */
  SlabField heights_of_map(const SurfaceParameters &parameters,
                           const std::string       &file,
                           const SlabLayoutPtr     &layout,
                           Remarks                 &remarks);
} // namespace strait

#endif
