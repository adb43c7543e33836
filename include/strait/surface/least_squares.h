// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_least_squares_h
#define strait_surface_least_squares_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /**
   * Subtract from the valid points of @p map the polynomial that fits them best:
   * the first @p n_terms of 1, x, y, x², xy, y².
   */
  void subtract_polynomial(HeightMap &map, int n_terms);
} // namespace strait

#endif
