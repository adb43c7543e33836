// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_npy_h
#define strait_surface_readers_npy_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /** The first bytes of every .npy file. */
  inline constexpr char npy_magic[] = "\x93NUMPY";

  /**
   * Read a two-dimensional numpy array (.npy of version 1, 2 or 3) of shape
   * (ny, nx): little-endian f4, f8, i2, i4 or i8, in C or Fortran order.
   * Throws InputError for any other content, or if the length of the file is
   * not what the header promises.
   */
  HeightMap read_npy(const std::string &file);
} // namespace strait

#endif
