// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace strait
{
  /** From now on SIGTERM, SIGINT and SIGUSR1 do not end the program but are noted for
   *  stop_requested(); the same signal again ends it at once, as a message says after
   *  Ctrl-C. Earlier signals are forgotten. A file that exceeds the size that the system
   *  allows makes writing fail instead of ending the program. Call after MPI_Init. */
  void catch_signals();

  /** Whether any rank was asked to stop; the same on all ranks. Collective. */
  bool stop_requested(MPI_Comm comm);

  /** The name of the signal that this rank got; "a signal" if only another rank did. */
  std::string name_of_stop_signal();

  /** The function that interruption_point() calls, if any. */
  inline std::function<void()> at_interruption_points;

  /** Called by long computations between their iterations. It may throw, which ends the
   *  computation. */
  inline void
  interruption_point()
  {
    if (at_interruption_points)
      at_interruption_points();
  }
} // namespace strait
