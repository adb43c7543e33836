// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_error_exit_h
#define strait_base_error_exit_h

#include <mpi.h>

#include <functional>

namespace strait
{
  /**
   * Run @p program and turn what it throws into an exit status and one sentence
   * on standard error: 2 for an InputError, 1 for anything else.
   *
   * If all ranks of @p comm fail, rank 0 speaks for them. If only some do, the
   * others wait for them in vain somewhere: after a few seconds the lowest rank
   * that failed speaks and all ranks are aborted with the same status.
   */
  int with_clear_exit(MPI_Comm comm, const std::function<int()> &program);
} // namespace strait

#endif
