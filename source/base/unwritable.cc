// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/unwritable.h>

#include <cerrno>
#include <cstring>

namespace strait
{
  namespace
  {
    bool
    is_lack_of_room(const int error)
    {
      return error == ENOSPC || error == EDQUOT || error == EFBIG;
    }
  } // namespace

  void
  throw_unfinished(const std::string &what, const int error)
  {
    const bool lacks_room = error == 0 || is_lack_of_room(error);
    throw ComputationError(what + " could not be written (" +
                           (error != 0 ? std::strerror(error) : "is the disk full?") +
                           "); " + (lacks_room ? "make room" : "mend that") +
                           ", and continue with --resume if a step was complete.");
  }

  void
  throw_unwritable(const std::string &what, const int error)
  {
    const std::string found =
      what + " cannot be written" +
      (error == 0 ? "" : std::string(" (") + std::strerror(error) + ")");
    if (is_lack_of_room(error))
      throw ComputationError(
        found + "; make room, and continue with --resume if the run had begun.");
    throw InputError(found + "; choose another with Output/Directory or --output.");
  }
} // namespace strait
