// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>

namespace strait
{
  /** The content of a file; empty if it cannot be read. */
  std::string text_of(const std::string &path);

  /** Write a whole file, replacing an earlier one. Throws ComputationError if that fails;
   *  the earlier file then stays. */
  void write_text(const std::string &path, const std::string &text);

  /** Make sure that a file with @p bytes of fields can be written at @p path, because the
   *  HDF5 library does not survive a full disk. Collective. Throws ComputationError on
   *  all ranks if there is no room. */
  void require_space(const std::string &path, std::uintmax_t bytes, MPI_Comm comm);

  /** Throw ComputationError unless the file @p path ends with @p end: a library may leave
   *  an incomplete file and report no error. */
  void require_end(const std::string &path, const std::string &end);

  /** Throw because @p what, such as "The log file 'X'", cannot be written. @p error is
   *  the value of errno, 0 if unknown. ComputationError if there is no room, which can
   *  happen in the middle of a run; else InputError, because another folder helps. */
  [[noreturn]] void throw_unwritable(const std::string &what, int error);

  /** Throw ComputationError because @p what, such as "The file 'X'", of a run that has
   *  begun could not be written. @p error is the value of errno, 0 if unknown. */
  [[noreturn]] void throw_unfinished(const std::string &what, int error = 0);

  /** The same for a @p reason that is not a lack of room. */
  [[noreturn]] void throw_unfinished(const std::string &what, const std::string &reason);
} // namespace strait
