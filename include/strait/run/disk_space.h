// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_disk_space_h
#define strait_run_disk_space_h

#include <mpi.h>

#include <cstdint>
#include <string>

namespace strait
{
  /**
   * Make sure that a file with @p bytes of fields can be written at @p path: the HDF5
   * library does not survive a disk that is full. Collective. Throws ComputationError on
   * all ranks if it cannot.
   */
  void require_space(const std::string &path, std::uintmax_t bytes, MPI_Comm comm);

  /** Throws ComputationError unless the file @p path ends with @p end: a library may
   *  leave half of it without a word. */
  void require_end(const std::string &path, const std::string &end);

  /** Write a whole file in the place of the one before. Throws ComputationError if that
   *  fails; then the one before stays. */
  void write_text(const std::string &path, const std::string &text);
} // namespace strait

#endif
