// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/contact_state.h>

namespace strait
{
  /** To how many digits of its tolerance a contact is solved. Half of them, which are
   * 1e-4 of 1e-8, tell where its throats are, unless it is about to close. */
  enum class Digits
  {
    half,
    all
  };

  /**
   * A half-space against one surface, whatever acts between them. It remembers nothing:
   * what a state owes to its past comes in with the state that it starts from.
   */
  class ContactModel
  {
  public:
    virtual ~ContactModel() = default;

    /**
     * The state under the nominal pressure or, in gap control, at the mean gap @p target,
     * reached from the state @p from, or without a past if that is null. A fluid of the
     * pressure @p fluid_pressure, on the grid of the heights, perhaps with windows, which
     * the state then has, and continued under the contact, presses the walls apart unless
     * that is null: it displaces the half-space and carries its mean pressure of the
     * load, and a point opens where the solid would press less than the fluid. Half of
     * the @p digits are only meant for a state that is solved once more, from there; a
     * model may always solve to all of them. Collective. Throws InputError if there is no
     * such state, ComputationError if the fluid carries more than the load.
     */
    virtual ContactState solve(double              target,
                               const ContactState *from           = nullptr,
                               const SlabField    *fluid_pressure = nullptr,
                               Digits              digits         = Digits::all) = 0;
  };
} // namespace strait
