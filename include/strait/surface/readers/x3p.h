// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_x3p_h
#define strait_surface_readers_x3p_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /** The first bytes of every zip archive. */
  inline constexpr char zip_magic[] = "PK\x03\x04";

  /**
   * Read an X3P file (ISO 25178-72): a matrix with regular x and y axes, its
   * heights 16 or 32 bit integers or floating-point numbers in the archive, or a
   * list in the XML; lengths in metres. NaN, points that the list of valid points
   * excludes, and empty entries of the list are missing.
   */
  HeightMap read_x3p(const std::string &file);
} // namespace strait

#endif
