// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_model_h
#define strait_contact_contact_model_h

#include <strait/contact/contact_state.h>

#include <cstddef>

namespace strait
{
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

    /**
     * Where the result depends on the states before: keep the present one, and
     * later go back to it.
     */
    virtual void
    keep_state()
    {
    }

    virtual void
    return_to_kept_state()
    {
    }

    /** Largest number of bytes held on this rank during a solve so far. */
    virtual std::size_t memory_consumption() const = 0;
  };
} // namespace strait

#endif
