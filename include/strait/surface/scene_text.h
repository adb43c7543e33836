// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_scene_text_h
#define strait_surface_scene_text_h

#include <strait/base/surface_parameters.h>

#include <string>

namespace strait
{
  /** @p value with nine significant digits, as one would write it in a scene. */
  std::string scene_number(double value);

  /**
   * "along_x, along_y", the values that a scene must give for a surface as it
   * is before the rotation that @p parameters ask for.
   */
  std::string
  scene_pair(const SurfaceParameters &parameters, double along_x, double along_y);
} // namespace strait

#endif
