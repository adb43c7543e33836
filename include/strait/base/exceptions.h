// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace strait
{
  /** Something the user can fix: a bad scene, input file or command line. The message is
   *  one sentence that says what is wrong, where, and what to do. The program prints it
   *  once and ends with status 2. */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** Throw InputError with @p message unless @p condition is true. */
  inline void
  require(const bool condition, const std::string &message)
  {
    if (!condition)
      throw InputError(message);
  }

  /** A computation that could not be completed although the input was valid. The program
   *  prints the message once and ends with status 1. */
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** The run was asked to stop and did, after a step or a solve of a search; it can be
   *  resumed. The program prints the message once and ends with status 3. */
  class Interruption : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace strait
