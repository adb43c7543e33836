// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/signals.h>

#include <csignal>

namespace strait
{
  namespace
  {
    volatile std::sig_atomic_t caught = 0;

    extern "C" void
    note_signal(const int number)
    {
      caught = number;
    }
  } // namespace

  void
  catch_signals()
  {
    caught = 0;
    for (const int number : {SIGTERM, SIGINT, SIGUSR1})
      {
        struct sigaction action = {};
        action.sa_handler       = note_signal;
        // Reads and writes go on; the second signal does what it always does.
        action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
        sigemptyset(&action.sa_mask);
        sigaction(number, &action, nullptr);
      }
    std::signal(SIGXFSZ, SIG_IGN);
  }

  bool
  stop_requested(MPI_Comm comm)
  {
    int number = caught;
    MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT, MPI_MAX, comm);
    return number != 0;
  }

  std::string
  name_of_stop_signal()
  {
    switch (caught)
      {
        case SIGTERM:
          return "SIGTERM";
        case SIGINT:
          return "SIGINT";
        case SIGUSR1:
          return "SIGUSR1";
        default:
          return "a signal";
      }
  }
} // namespace strait
