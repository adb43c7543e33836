// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_sdf_h
#define strait_surface_readers_sdf_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /** Whether a file that begins with @p start is a surface data file. */
  bool is_sdf(const std::string &start);

  /**
   * Read a surface data file (ISO 25178-71, and BCR-STM 1.0 before it), ASCII or
   * binary; lengths in metres. BAD, the reserved value of the integer types and
   * NaN mark missing points. Throws InputError for compressed data, an unknown
   * type, or data that are shorter than the header promises.
   */
  HeightMap read_sdf(const std::string &file);
} // namespace strait

#endif
