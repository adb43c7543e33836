// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/signals.h>

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace strait
{
  namespace
  {
    // The signal noted last, 0: none; whether this rank prints messages, as rank 0 does.
    volatile std::sig_atomic_t caught = 0, speaks = 0;

    /** Print by write(): a handler of signals may not use streams. */
    void
    say(const char *sentence)
    {
      if (speaks != 0 && write(STDERR_FILENO, sentence, std::strlen(sentence)) < 0)
        speaks = 0;
    }

    extern "C" void
    note_signal(const int number)
    {
      if (caught == number)
        {
          say(
            "\nstrait: Ended at once, as it was asked to twice; --resume continues from "
            "the last checkpoint, if there is one.\n");
          std::signal(number, SIG_DFL);
          std::raise(number); // takes effect when this handler returns
          return;
        }
      caught = number;
      if (number == SIGINT)
        say(
          "\nstrait: This step, or solve of a search, is completed first; Ctrl-C again "
          "ends the run at once.\n");
    }
  } // namespace

  void
  catch_signals()
  {
    speaks = rank_in(MPI_COMM_WORLD) == 0 ? 1 : 0;
    caught = 0;
    for (const int number : {SIGTERM, SIGINT, SIGUSR1})
      {
        struct sigaction action = {};
        action.sa_handler       = note_signal;
        action.sa_flags         = SA_RESTART; // continue interrupted reads and writes
        sigemptyset(&action.sa_mask);
        sigaction(number, &action, nullptr);
      }
    std::signal(SIGXFSZ, SIG_IGN);
  }

  bool
  stop_requested(MPI_Comm comm)
  {
    return maximum(comm, caught) > 0;
  }

  std::string
  name_of_stop_signal()
  {
    return caught == 0 ? "a signal" : std::string("SIG") + sigabbrev_np(caught);
  }
} // namespace strait
