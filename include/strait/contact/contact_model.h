// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_model_h
#define strait_contact_contact_model_h

#include <strait/contact/contact_state.h>

#include <cstddef>

namespace strait
{
  /** What a state depends on besides its load, where it depends on its past. */
  struct ContactMemory
  {
    SlabField gap; // empty: nothing yet, or no such dependence
    double    target = 0;
  };

  /** A half-space against one surface, load after load, whatever acts between them. */
  class ContactModel
  {
  public:
    virtual ~ContactModel() = default;

    /**
     * The state under the nominal pressure or, in gap control, at the mean gap
     * @p target. Collective. Throws InputError if there is no such state.
     */
    virtual ContactState solve(double target) = 0;

    /** Start the next solve anew, without the states before. */
    virtual void forget() = 0;

    /** What the next solve starts from, where its result depends on that. */
    virtual ContactMemory
    memory() const
    {
      return {};
    }

    /** Start the next solve from there. */
    virtual void
    recall(const ContactMemory &)
    {
    }

    /** All that later solves depend on, be it within the tolerance only. Collective. */
    virtual void
    transfer(StateArchive &)
    {
    }

    /** Largest number of bytes held on this rank during a solve so far. */
    virtual std::size_t memory_consumption() const = 0;
  };
} // namespace strait

#endif
