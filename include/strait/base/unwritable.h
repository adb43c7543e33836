// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_unwritable_h
#define strait_base_unwritable_h

#include <string>

namespace strait
{
  /**
   * Throws because @p what, "The log file 'X'", cannot be written, for the reason
   * @p error, a value of errno: ComputationError if there is no room, which may be so in
   * the middle of a run, else InputError, as another folder mends it.
   */
  [[noreturn]] void throw_unwritable(const std::string &what, int error);

  /**
   * Throws ComputationError because @p what, "The file 'X'", of a run that has begun
   * could not be written, for the reason @p error, a value of errno or 0 for one that is
   * not known.
   */
  [[noreturn]] void throw_unfinished(const std::string &what, int error = 0);
} // namespace strait

#endif
