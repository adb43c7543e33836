// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_signals_h
#define strait_base_signals_h

#include <mpi.h>

#include <functional>
#include <string>

namespace strait
{
  /**
   * From now on SIGTERM, SIGINT and SIGUSR1 do not end the program but are noted for
   * stop_requested(); the same one again ends it at once. Who presses Ctrl-C is told so.
   * Those before are forgotten. A file that grows beyond what the system allows makes its
   * writing fail rather than end the program. After MPI has started.
   */
  void catch_signals();

  /** Whether a rank was asked to stop. The same on all ranks; collective. */
  bool stop_requested(MPI_Comm comm);

  /** The name of the signal that this rank got, "a signal" if it was another rank. */
  std::string name_of_stop_signal();

  /**
   * Called by what takes long between its iterations: there it may be left by an
   * exception. Nothing happens unless at_interruption_points() was called.
   */
  void interruption_point();

  /** Let interruption_point() call @p check from now on. */
  void at_interruption_points(std::function<void()> check);
} // namespace strait

#endif
