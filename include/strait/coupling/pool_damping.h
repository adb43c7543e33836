// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_coupling_pool_damping_h
#define strait_coupling_pool_damping_h

#include <strait/percolation/clusters.h>
#include <strait/spectral/slab_field.h>

#include <cstdint>
#include <vector>

namespace strait
{
  /**
   * Lets the iteration of contact and flow come to rest where a trapped pool opens and
   * closes from round to round.
   *
   * The pressure in a region jumps when it is cut off from the fluid. Where the fluid's
   * pressure cuts it off and the pool's own lets the fluid in again there is no state
   * with either: in the limit the fluid enters until the region is about to be cut off.
   * That is where the pressure comes to rest if each change takes a smaller share of
   * the step: at a point that has become part of a pool or ceased to be so more often
   * than @c changes_allowed in this iteration, half as much with each change.
   */
  class PoolDamping
  {
  public:
    /** Begin an iteration: nothing has changed yet. */
    void restart();

    /** Take note of the states of the next round, one per local grid point. */
    void note(const std::vector<NodeState> &states);

    /** Of the steps from @p before to @p pressure, take the share that is allowed at
     *  the open points. */
    void
    limit_open(SlabField &pressure, const SlabField &before) const
    {
      limit(pressure, before, false);
    }

    /** The same at the closed ones. */
    void
    limit_closed(SlabField &pressure, const SlabField &before) const
    {
      limit(pressure, before, true);
    }

    /** Bytes on this rank. */
    std::size_t
    memory_consumption() const
    {
      return states.capacity() + n_changes.capacity();
    }

  private:
    static constexpr int changes_allowed = 2;

    void limit(SlabField &pressure, const SlabField &before, bool closed) const;

    std::vector<NodeState>    states;    // of the last round
    std::vector<std::uint8_t> n_changes; // per local grid point
  };
} // namespace strait

#endif
