// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_file_surface_h
#define strait_surface_file_surface_h

#include <strait/base/surface_parameters.h>
#include <strait/surface/readers/height_map.h>
#include <strait/surface/surface.h>

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
   * A measured map from a file, processed as the scene says: row 0 of the file is
   * y = 0. Unless the scene resamples it, the grid must have as many points as the
   * map. Rank 0 reads, processes and keeps it.
   */
  class FileSurface : public Surface
  {
  public:
    /**
     * Collective. Throws InputError for a bad file, and where the file states a
     * size that differs from the scene's by more than a thousandth.
     */
    FileSurface(const SurfaceParameters &parameters,
                const std::string       &file,
                MPI_Comm                 communicator);

    /**
     * Throws InputError if the grid of @p layout is not that of the map and the scene
     * does not resample.
     */
    SlabField heights(const SlabLayoutPtr &layout) const override;

    Remarks remarks() const override;

  private:
    std::vector<double> values_on(const PeriodicGrid &grid) const;

    SurfaceParameters   scene;
    std::string         file;
    HeightMap           map; // without values except on rank 0
    Remarks             of_map;
    mutable std::string of_grid; // what became of it on the last grid
  };
} // namespace strait

#endif
