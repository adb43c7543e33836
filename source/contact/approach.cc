// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/approach.h>

#include <algorithm>
#include <limits>

namespace strait
{
  Approach::Approach(const double target)
    : at(target)
  {
  }

  Approach::Approach(const double     target,
                     const SlabField &before,
                     const double     target_before)
    : at(target)
    , came_from(target_before)
  {
    const double largest = max_value(before);
    if (target == target_before || !(largest > 0))
      return;
    scale = largest;
    earlier.resize(before.size());
    for (std::size_t i = 0; i < earlier.size(); ++i)
      earlier[i] = static_cast<float>(before[i] / scale);
  }

  double
  Approach::steps_to(const double next) const
  {
    return scale > 0 ? (next - at) / (at - came_from)
                     : std::numeric_limits<double>::infinity();
  }

  SlabField
  Approach::extrapolated(const SlabField &here, const double next) const
  {
    const double ratio = steps_to(next);
    SlabField    field = here;
    for (std::size_t i = 0; i < field.size(); ++i)
      if (here[i] > 0)
        field[i] = std::max(0., here[i] + ratio * (here[i] - earlier[i] * scale));
    return field;
  }

  void
  Approach::transfer(StateArchive &archive, const SlabLayout &layout)
  {
    archive.value(at);
    archive.value(came_from);
    archive.field(earlier, layout);
    archive.value(scale);
  }
} // namespace strait
