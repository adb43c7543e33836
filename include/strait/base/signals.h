// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace strait
{
  /** From now on SIGTERM, SIGINT and SIGUSR1 do not end the program but are noted for
   *  stop_requested(); the same one again ends it at once. Who presses Ctrl-C is told so.
   *  Those before are forgotten. A file that grows beyond what the system allows makes
   *  its writing fail rather than end the program. After MPI has started. */
  void catch_signals();

  /** Whether a rank was asked to stop. The same on all ranks; collective. */
  bool stop_requested(MPI_Comm comm);

  /** The name of the signal that this rank got, "a signal" if it was another rank. */
  std::string name_of_stop_signal();

  /** What interruption_point() calls, if anything. */
  inline std::function<void()> at_interruption_points;

  /** Called by what takes long between its iterations: there it may be left by an
   *  exception. */
  inline void
  interruption_point()
  {
    if (at_interruption_points)
      at_interruption_points();
  }
} // namespace strait
