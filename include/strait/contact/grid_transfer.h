// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** Whether a grid of half the points each way has at least 32 × 32. */
  bool can_be_coarsened(const PeriodicGrid &grid);

  /**
   * Every second point of every second row of @p fine, whose grid
   * can_be_coarsened(). Collective.
   */
  SlabField restrict_by_injection(const SlabField &fine);

  /**
   * Bilinear interpolation of @p coarse to the grid of twice the points each way
   * of @p fine_layout. Collective.
   */
  SlabField prolong_bilinearly(const SlabField &coarse, const SlabLayoutPtr &fine_layout);

  /**
   * The @p pressure of a contact with the windows @p windows in place of its own, as a
   * start for the solution with them: what is known in a window is kept, the rest is
   * interpolated from the window's parent. Collective.
   */
  SlabField zoom_in(const SlabField &pressure, std::vector<ZoomWindow> windows);

  /** The same of any field, linear between the points of the parent. Collective. */
  SlabField zoom_in_linearly(const SlabField &field, std::vector<ZoomWindow> windows);

  /** What @p field, linear between the points of the parent of its window @p w, has at
   *  the points of that and at those around it, one column and one row on each side: row
   *  by row. Collective if the parent is the grid. */
  std::vector<double> around_window(const SlabField &field, int w);
} // namespace strait
