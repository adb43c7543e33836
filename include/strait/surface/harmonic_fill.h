// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_harmonic_fill_h
#define strait_surface_harmonic_fill_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /**
   * Replace NaN by the solution of the discrete Laplace equation with the valid
   * points as boundary values, and no flux through the edges of the map, by elimination.
   * At least one point must be valid.
   */
  void fill_harmonically(HeightMap &map);
} // namespace strait

#endif
