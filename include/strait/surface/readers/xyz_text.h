// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_xyz_text_h
#define strait_surface_readers_xyz_text_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /**
   * Read lines of x, y, z, separated as TextRow says, in any order, below any
   * number of header lines (those of read_matrix_text() have the same meaning,
   * sizes apart). The points must lie on a regular grid, to a twentieth of its
   * spacings; grid points without a line count as missing, as do those whose z
   * is no number but two words or one, such as "No Data".
   * Throws InputError for points that form no grid, or name one twice.
   */
  HeightMap read_xyz_text(const std::string &file);
} // namespace strait

#endif
