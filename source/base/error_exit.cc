// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/error_exit.h>
#include <strait/base/exceptions.h>

#include <chrono>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace strait
{
  namespace
  {
    /** Whether all ranks arrive here within a few seconds. */
    bool
    all_ranks_failed(MPI_Comm comm)
    {
      using Clock = std::chrono::steady_clock;
      MPI_Request request;
      MPI_Ibarrier(comm, &request);
      const auto give_up = Clock::now() + std::chrono::seconds(3);
      int        done    = 0;
      while (done == 0 && Clock::now() < give_up)
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      return done != 0;
    }

    int
    report(MPI_Comm comm, const int status, const std::string &message)
    {
      int rank = 0, n_ranks = 1;
      MPI_Comm_rank(comm, &rank);
      MPI_Comm_size(comm, &n_ranks);
      const bool together = n_ranks == 1 || all_ranks_failed(comm);
      if (!together || rank == 0)
        std::cerr << "strait: " << (status == 1 ? "error: " : "") << message
                  << (together ? "" : " (on rank " + std::to_string(rank) + ")")
                  << std::endl;
      if (!together)
        MPI_Abort(comm, status);
      return status;
    }
  } // namespace

  int
  with_clear_exit(MPI_Comm comm, const std::function<int()> &program)
  {
    try
      {
        return program();
      }
    catch (const InputError &error)
      {
        return report(comm, 2, error.what());
      }
    catch (const Interruption &stop)
      {
        return report(comm, 3, stop.what());
      }
    catch (const std::bad_alloc &)
      {
        return report(comm, 1, "The memory of this machine does not suffice.");
      }
    catch (const std::exception &error)
      {
        return report(comm, 1, error.what());
      }
    catch (...) // Trilinos throws integers
      {
        return report(comm, 1, "A library failed without saying why.");
      }
  }
} // namespace strait
