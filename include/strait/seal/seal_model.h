// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_seal_model_h
#define strait_seal_seal_model_h

#include <strait/seal/seal_state.h>

namespace strait
{
  /** What a state is wanted for. */
  enum class Aim
  {
    throats,  // where its throats are, to place windows there
    verdict,  // whether a channel percolates
    seal,     // the same; if one does, the state is lost and need not be exact
    leak_rate // how much leaks, to the accuracy that the scene asks for
  };

  /**
   * What makes a state of a seal out of what the outside prescribes: a surface that is
   * the gap itself, a contact, a contact with adhesion, or one that a fluid presses
   * apart. It remembers nothing; the past comes in with the state that a path comes from.
   */
  class SealModel
  {
  public:
    virtual ~SealModel() = default;

    /** The state under @p control, reached from @p from, or without a past if that is
     *  null; a model may do more than the aim needs. Collective. Throws InputError if
     * there is no such state. */
    virtual SealState solve(const Control &control, const SealState *from, Aim aim) = 0;
  };
} // namespace strait

#endif
