// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/coupling/pool_damping.h>

#include <cmath>
#include <limits>

namespace strait
{
  void
  PoolDamping::restart()
  {
    states.clear();
    n_changes.clear();
  }

  void
  PoolDamping::note(const std::vector<NodeState> &now)
  {
    constexpr auto most = std::numeric_limits<std::uint8_t>::max();
    n_changes.resize(now.size());
    for (std::size_t k = 0; k < states.size(); ++k)
      if ((states[k] == NodeState::pocket) != (now[k] == NodeState::pocket) &&
          n_changes[k] < most)
        ++n_changes[k];
    states = now;
  }

  void
  PoolDamping::limit(SlabField       &pressure,
                     const SlabField &before,
                     const bool       closed) const
  {
    for (std::size_t k = 0; k < n_changes.size(); ++k)
      if (n_changes[k] > changes_allowed && closed == (states[k] == NodeState::closed))
        pressure[k] =
          before[k] + std::ldexp(pressure[k] - before[k], changes_allowed - n_changes[k]);
  }
} // namespace strait
