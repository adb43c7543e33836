// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

namespace strait
{
  /** Compute the values in the windows of @p field from those at the grid points, by the
   *  Fourier series of these: exact for all waves that the grid resolves. Collective. */
  void fill_windows(SlabField &field);

  /** Give each point that a window covers the value of the window's coinciding point. */
  void copy_to_covered(SlabField &field);
} // namespace strait
