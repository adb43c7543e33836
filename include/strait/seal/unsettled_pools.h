// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_unsettled_pools_h
#define strait_seal_unsettled_pools_h

#include <strait/percolation/clusters.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace strait
{
  /**
   * The trapped pools for which there is no state with the pool pressure.
   *
   * Let a pool be dry where the fluid comes in as soon as it is, and let it be cut off
   * once the fluid is in: its pressure jumps with each round of the iteration between
   * contact and flow. In truth it stays full, at the pressure at which it was cut off.
   * The same goes for a gap that only opens under the pressure that is continued across a
   * contact. So what has become a pool or ceased to be one more than @c changes_allowed
   * times does not count as a pool any more, but as what it was before (state_before()):
   * as part of the region that it was joined to, or as contact.
   */
  class UnsettledPools
  {
  public:
    /** Take note of the states of the next round, one per local grid point. */
    void note(const std::vector<NodeState> &now);

    /** Whether a local grid point is in such a pool. */
    bool
    contains(const std::size_t k) const
    {
      return was_pool[k] && n_changes[k] > changes_allowed;
    }

    /** What a local grid point in such a pool last was but a pool. */
    NodeState
    state_before(const std::size_t k) const
    {
      return before[k];
    }

  private:
    // With none, a pool that forms on the way to the state would never count as one; with
    // twice as many, pools that come and go cost more rounds before they are held.
    static constexpr int changes_allowed = 1;

    std::vector<NodeState>    before;
    std::vector<std::uint8_t> was_pool; // in the last round
    std::vector<std::uint8_t> n_changes;
  };
} // namespace strait

#endif
