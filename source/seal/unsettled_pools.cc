// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/unsettled_pools.h>

namespace strait
{
  void
  UnsettledPools::note(const std::vector<NodeState> &now)
  {
    const bool is_first = was_pool.empty();
    before.resize(now.size(), NodeState::closed);
    was_pool.resize(now.size());
    n_changes.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k)
      {
        const std::uint8_t is_pool = now[k] == NodeState::trapped ? 1 : 0;
        if (!is_first && is_pool != was_pool[k] && n_changes[k] <= changes_allowed)
          ++n_changes[k];
        was_pool[k] = is_pool;
        if (is_pool == 0)
          before[k] = now[k];
      }
  }
} // namespace strait
