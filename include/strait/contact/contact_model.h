// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/contact_state.h>

namespace strait
{
  /** How many digits of its tolerance a contact is solved to. Half of them, 1e-4 for a
   *  tolerance of 1e-8, locate the throats, unless the seal is about to close. */
  enum class Digits
  {
    half,
    all
  };

  /**
   * A half-space against one surface, for any interaction between them. A model keeps no
   * memory: a state depends on the past only through the state that it starts from.
   */
  class ContactModel
  {
  public:
    virtual ~ContactModel() = default;

    /**
     * Return the state at @p target, a nominal pressure or, in gap control, a mean gap.
     * It is reached from the state @p from, or has no past if that is null. Unless it is
     * null, a fluid of the pressure @p fluid_pressure presses the walls apart: it
     * displaces the half-space, its mean pressure carries part of the load, and a point
     * opens where the solid would press less than the fluid. The fluid pressure is given
     * on the grid of the heights, continued under the contact; if it has windows, so has
     * the state. Half of the @p digits are meant for a state from which the contact is
     * solved once more; a model may always compute all of them. Collective. Throws
     * InputError if there is no such state; without adhesion ComputationError if the
     * fluid carries all the load.
     */
    virtual ContactState solve(double              target,
                               const ContactState *from           = nullptr,
                               const SlabField    *fluid_pressure = nullptr,
                               Digits              digits         = Digits::all) = 0;
  };
} // namespace strait
