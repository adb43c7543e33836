// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_statistics_h
#define strait_surface_statistics_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /** Numbers that characterise the roughness of a surface on its grid. */
  struct SurfaceStatistics
  {
    double rms_height       = 0.; // about the mean
    double rms_slope        = 0.; // √(Σ q² |h~|²)
    double rms_curvature    = 0.; // 1/Rc = √(½ Σ (qx⁴ + qy⁴) |h~|²)
    double curvature_radius = 0.; // Rc, infinite for a flat surface
    double highest          = 0.; // largest height
    double lowest           = 0.; // smallest height
  };

  /**
   * Statistics of @p height; lengths in its unit. Slope and curvature are those
   * of the trigonometric interpolant, hence exact for a surface whose waves the
   * grid resolves. Collective.
   */
  SurfaceStatistics statistics(const SlabField &height);
} // namespace strait

#endif
