// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/earlier_states.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /**
     * Largest relative step of the load that starts from the last states: beyond
     * it the coarser grids cost less (measured on self-affine surfaces).
     */
    constexpr double small_step = 0.12;
  } // namespace

  bool
  EarlierStates::start(const double target, SlabField &pressure)
  {
    const double step      = std::abs(target - last_target);
    const bool   near_last = last_target > 0 && step <= small_step * last_target;
    const double last_step = std::abs(last_target - earlier_target);
    const bool   near_both = near_last && earlier_target > 0 && step <= 2 * last_step;
    if (near_both)
      extrapolate(target, pressure);
    else if (near_last)
      remember(pressure);
    else
      forget();
    return near_last;
  }

  void
  EarlierStates::extrapolate(const double target, SlabField &pressure)
  {
    const double ratio = (target - last_target) / (last_target - earlier_target);
    const double scale = max_value(pressure);
    for (std::size_t i = 0; i < pressure.size(); ++i)
      {
        const double last    = pressure[i];
        const double earlier = earlier_pressure[i] * earlier_scale;
        if (last > 0)
          pressure[i] = std::max(0., last + ratio * (last - earlier));
        earlier_pressure[i] = static_cast<float>(last / scale);
      }
    earlier_scale  = scale;
    earlier_target = last_target;
  }

  /** Keep the last @p pressure as the earlier one of the next step. */
  void
  EarlierStates::remember(const SlabField &pressure)
  {
    earlier_scale  = max_value(pressure);
    earlier_target = last_target;
    earlier_pressure.resize(pressure.size());
    for (std::size_t i = 0; i < pressure.size(); ++i)
      earlier_pressure[i] = static_cast<float>(pressure[i] / earlier_scale);
  }

  void
  EarlierStates::keep_last()
  {
    earlier_pressure = std::vector<float>();
    earlier_target   = 0;
  }

  void
  EarlierStates::forget()
  {
    keep_last();
    last_target = 0;
  }

  void
  EarlierStates::transfer(StateArchive &archive, const SlabLayout &layout)
  {
    archive.value(last_target);
    archive.field(earlier_pressure, layout);
    archive.value(earlier_scale);
    archive.value(earlier_target);
  }
} // namespace strait
