// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>

#include <chrono>
#include <iostream>
#include <new>
#include <thread>

namespace strait
{
  namespace
  {
    /** An exception in a form that other ranks and the shell understand. */
    struct Failure
    {
      int         status = 0; // exit status; 0: no failure
      std::string message;
    };

    /** Status and message of the exception that is being handled. */
    Failure
    current_failure()
    {
      try
        {
          throw;
        }
      catch (const InputError &error)
        {
          return {2, error.what()};
        }
      catch (const Interruption &stop)
        {
          return {3, stop.what()};
        }
      catch (const std::bad_alloc &)
        {
          return {1, "The memory of this machine does not suffice."};
        }
      catch (const std::exception &error)
        {
          return {1, error.what()};
        }
      catch (...) // Trilinos throws integers
        {
          return {1, "A library failed without saying why."};
        }
    }

    /** Whether all ranks of @p comm call this within a few seconds. */
    bool
    all_ranks_failed(MPI_Comm comm)
    {
      using Clock = std::chrono::steady_clock;
      MPI_Request request;
      MPI_Ibarrier(comm, &request);
      // Ranks that fail together do so almost at once: a longer wait only delays the
      // message, and a shorter one might abort before a busy rank gets here.
      const auto give_up = Clock::now() + std::chrono::seconds(3);
      int        done    = 0;
      while (done == 0 && Clock::now() < give_up)
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      return done != 0;
    }

    void
    report(MPI_Comm comm, const Failure &failure)
    {
      const bool together = n_ranks_in(comm) == 1 || all_ranks_failed(comm);
      if (!together || rank_in(comm) == 0)
        std::cerr << "strait: " << (failure.status == 1 ? "error: " : "")
                  << failure.message
                  << (together ? "" : " (on rank " + std::to_string(rank_in(comm)) + ")")
                  << std::endl;
      if (!together)
        MPI_Abort(comm, failure.status);
    }
  } // namespace

  int
  with_clear_exit(MPI_Comm comm, const std::function<int()> &program)
  {
    try
      {
        return program();
      }
    catch (...)
      {
        const Failure failure = current_failure();
        report(comm, failure);
        return failure.status;
      }
  }

  void
  run_on_root(MPI_Comm comm, const std::function<void()> &action)
  {
    Failure failure;
    if (rank_in(comm) == 0)
      try
        {
          action();
        }
      catch (...)
        {
          failure = current_failure();
        }
    MPI_Bcast(&failure.status, 1, MPI_INT, 0, comm);
    if (failure.status == 0)
      return;
    const std::string message = broadcast(comm, failure.message);
    if (failure.status == 2)
      throw InputError(message);
    throw ComputationError(message);
  }

  void
  throw_if_any(MPI_Comm comm, const std::string &error)
  {
    const int  n_ranks = n_ranks_in(comm);
    const auto first =
      static_cast<int>(minimum(comm, error.empty() ? n_ranks : rank_in(comm)));
    if (first < n_ranks)
      throw InputError(broadcast(comm, error, first));
  }

  std::string
  broadcast(MPI_Comm comm, std::string text, const int root)
  {
    unsigned long long length = text.size();
    MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, root, comm);
    text.resize(length);
    MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root, comm);
    return text;
  }
} // namespace strait
