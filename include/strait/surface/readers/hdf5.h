// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_hdf5_h
#define strait_surface_readers_hdf5_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /** The first bytes of an HDF5 file. */
  inline constexpr char hdf5_magic[] = "\x89HDF";

  /**
   * Read a two-dimensional data set of numbers of shape (ny, nx) from an HDF5
   * file: the one that source.dataset names, or the only one. Of its attributes
   * and those of the file, "unit" or "units" states the unit of the heights,
   * "lx" and "ly", or "dx" and "dy", the size, "lateral_unit" its unit and
   * "periodic" whether the map repeats itself.
   */
  HeightMap read_hdf5(const MapSource &source);
} // namespace strait

#endif
