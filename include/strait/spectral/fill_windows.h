// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * Find the values of the windows of @p field from those at the grid points, by its
   * Fourier series: exact for what the grid resolves. Collective.
   */
  void fill_windows(SlabField &field);

  /** Give each point that a window covers the value of the window's point that it is. */
  void copy_to_covered(SlabField &field);
} // namespace strait
