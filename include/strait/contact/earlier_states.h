// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_earlier_states_h
#define strait_contact_earlier_states_h

#include <strait/spectral/slab_field.h>
#include <strait/spectral/state_archive.h>

#include <cstddef>
#include <vector>

namespace strait
{
  /**
   * What the last loads say about the contact pressure under the next: near to one of
   * them its pressure is a start, near to two the line through theirs.
   */
  class EarlierStates
  {
  public:
    /**
     * Turn @p pressure, that of the last state, into a start for the load (or mean gap)
     * @p target. Returns false, and forgets, if no state is near enough. Collective.
     */
    bool start(double target, SlabField &pressure);

    /** The pressure given to the next start() is that of the load @p target. */
    void
    arrived(const double target)
    {
      last_target = target;
    }

    /** No start may use more than the last state. */
    void keep_last();

    void forget();

    /** What the next start depends on, but for the last pressure itself. Collective. */
    void transfer(StateArchive &archive, const SlabLayout &layout);

    /** Bytes on this rank. */
    std::size_t
    memory_consumption() const
    {
      return earlier_pressure.size() * sizeof(float);
    }

  private:
    void extrapolate(double target, SlabField &pressure);
    void remember(const SlabField &pressure);

    double last_target    = 0; // 0: there is none
    double earlier_target = 0; // likewise

    // Of the state before the last. Single precision, in units of `earlier_scale`, is
    // enough to extrapolate.
    std::vector<float> earlier_pressure;
    double             earlier_scale = 0;
  };
} // namespace strait

#endif
