// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/scene_text.h>

namespace strait
{
  std::string
  scene_number(const double value)
  {
    return format("%.9g", value);
  }

  std::string
  scene_pair(const SurfaceParameters &parameters,
             const double             along_x,
             const double             along_y)
  {
    const double first  = parameters.rotate ? along_y : along_x;
    const double second = parameters.rotate ? along_x : along_y;
    return scene_number(first) + ", " + scene_number(second);
  }
} // namespace strait
