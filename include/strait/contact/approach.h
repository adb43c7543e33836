// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_approach_h
#define strait_contact_approach_h

#include <strait/spectral/slab_field.h>
#include <strait/spectral/state_archive.h>

#include <vector>

namespace strait
{
  /**
   * Where a state was come to from: the field of the state before it (the pressure, or
   * with adhesion the gap). The line through both foretells a third state.
   */
  class Approach
  {
  public:
    Approach() = default;

    /** To a first state, at the load (or mean gap) @p target. */
    explicit Approach(double target);

    /** To a state at @p target from @p before, that of the state at @p target_before.
     *  Collective. */
    Approach(double target, const SlabField &before, double target_before);

    /** The load (or mean gap) of the state that was come to. */
    double
    target() const
    {
      return at;
    }

    /** How many times further than from the state before to this one @p next is from
     *  this one; negative on the way back, infinite where no state before is known. */
    double steps_to(double next) const;

    /**
     * The field at @p next on the line through @p here, that of this state, and the one
     * before. What is 0 here stays 0, and nothing falls below 0.
     */
    SlabField extrapolated(const SlabField &here, double next) const;

    /** In either direction. Collective. */
    void transfer(StateArchive &archive, const SlabLayout &layout);

  private:
    double at        = 0;
    double came_from = 0;
    // Single precision, in units of `scale`, is enough to extrapolate.
    std::vector<float> earlier;
    double             scale = 0; // 0: no state before is known
  };
} // namespace strait

#endif
