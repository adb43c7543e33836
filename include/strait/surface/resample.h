// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_resample_h
#define strait_surface_resample_h

#include <strait/spectral/periodic_grid.h>

#include <vector>

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
} // namespace strait

#endif
