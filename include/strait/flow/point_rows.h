// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_point_rows_h
#define strait_flow_point_rows_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /** Rows of equally spaced points, in units of the grid's spacings. */
  struct PointRows
  {
    double x0   = 0.;
    double y0   = 0.;
    double step = 1.;
    int    nx   = 0;
    int    ny   = 0;
  };

  /** The grid points in steps of @p stride that are counted from 0, without the seam's
   *  copies. */
  PointRows rows_of_grid(const PeriodicGrid &grid, int stride);

  /** The points of window @p window. */
  PointRows rows_of_window(const SlabLayout &layout, int window);
} // namespace strait

#endif
