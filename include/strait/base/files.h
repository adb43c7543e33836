// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>

namespace strait
{
  /** What is in a file; nothing if there is none. */
  std::string text_of(const std::string &path);

  /** Write a whole file in the place of the one before. Throws ComputationError if that
   *  fails; then the one before stays. */
  void write_text(const std::string &path, const std::string &text);

  /** Make sure that a file with @p bytes of fields can be written at @p path: the HDF5
   *  library does not survive a disk that is full. Collective. Throws ComputationError on
   *  all ranks if it cannot. */
  void require_space(const std::string &path, std::uintmax_t bytes, MPI_Comm comm);

  /** Throws ComputationError unless the file @p path ends with @p end: a library may
   *  leave half of it without a word. */
  void require_end(const std::string &path, const std::string &end);

  /** Throws because @p what, "The log file 'X'", cannot be written, for the reason
   *  @p error, a value of errno: ComputationError if there is no room, which may be so in
   *  the middle of a run, else InputError, as another folder mends it. */
  [[noreturn]] void throw_unwritable(const std::string &what, int error);

  /** Throws ComputationError because @p what, "The file 'X'", of a run that has begun
   *  could not be written, for the reason @p error, a value of errno or 0 for one that is
   *  not known. */
  [[noreturn]] void throw_unfinished(const std::string &what, int error = 0);
} // namespace strait
