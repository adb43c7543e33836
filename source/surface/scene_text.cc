// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/scene_text.h>

#include <utility>

namespace strait
{
  std::string
  scene_number(const double value)
  {
    return format("%.9g", value);
  }

  std::string
  scene_pair(const SurfaceParameters &parameters, double along_x, double along_y)
  {
    if (parameters.rotate)
      std::swap(along_x, along_y);
    return scene_number(along_x) + ", " + scene_number(along_y);
  }
} // namespace strait
