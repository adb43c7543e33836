// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_file_surface_h
#define strait_surface_file_surface_h

#include <strait/surface/readers/height_map.h>
#include <strait/surface/surface.h>

namespace strait
{
  /**
   * A height map from a file, point by point: row 0 of the file is y = 0, and
   * the grid must have as many points as the file. Rank 0 reads and keeps the
   * map.
   */
  class FileSurface : public Surface
  {
  public:
    /**
     * Collective. Throws InputError for a bad file, and where the file states a
     * size that differs from the scene's by more than a thousandth.
     */
    FileSurface(const SurfaceParameters &parameters, MPI_Comm communicator);

    /** Throws InputError if the grid of @p layout is not that of the file. */
    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    SurfaceParameters scene;
    HeightMap         map; // without values except on rank 0
  };
} // namespace strait

#endif
