// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** Whether every second point each way makes a periodic grid of at least 32 × 32. */
  bool can_be_coarsened(const PeriodicGrid &grid);

  /**
   * Take every second point of every second row of @p fine, whose grid
   * can_be_coarsened(). Collective.
   */
  SlabField restrict_by_injection(const SlabField &fine);

  /**
   * Interpolate @p coarse bilinearly to the grid of @p fine_layout, which has twice as
   * many points each way. Collective.
   */
  SlabField prolong_bilinearly(const SlabField &coarse, const SlabLayoutPtr &fine_layout);

  /**
   * Return the @p pressure of a contact with @p windows in place of its own, as a start
   * for the solution with them. Values in a window that @p pressure has as well are kept.
   * A new window is interpolated from its parent, and is 0 where the nearest point of the
   * parent does not touch. Collective.
   */
  SlabField zoom_in(const SlabField &pressure, std::vector<ZoomWindow> windows);

  /** As zoom_in(), for any field; new windows are interpolated bilinearly. Collective. */
  SlabField zoom_in_linearly(const SlabField &field, std::vector<ZoomWindow> windows);

  /** Interpolate @p field bilinearly from the parent of its window @p w to the points of
   *  the window and to one more column and row on each side. Return the values row by
   *  row. Collective if the parent is the grid. */
  std::vector<double> around_window(const SlabField &field, int w);
} // namespace strait
