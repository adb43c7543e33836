// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>
#include <pybind11/pybind11.h>

#include <csignal>
#include <functional>
#include <mutex>

namespace strait::python
{
  namespace py = pybind11;

  /**
   * Start MPI and the libraries that deal.II needs, unless that was done before. Whatever
   * computes calls this, so that the import of the package costs nothing. MPI gets no
   * arguments, so that those of the script stay its own. An MPI that is already running,
   * started by mpi4py for instance, is used and left to its owner.
   */
  void start();

  /** Register an object that must be freed before MPI ends, and the function for that. */
  void free_at_exit(void *object, std::function<void()> free);

  /** Remove an object that has been freed. */
  void forget_at_exit(void *object);

  /** The communicator of an object of mpi4py; that of all ranks if @p comm is None.
   *  Starts MPI. */
  MPI_Comm communicator_of(const py::object &comm);

  /**
   * While this exists, this thread computes and other threads of Python can run. Only one
   * thread computes at a time, as neither MPI nor the planner of FFTW can be shared. A
   * signal handler, or an object that it destroys, may compute again in the same thread.
   */
  class Computing
  {
    py::gil_scoped_release                released;
    std::lock_guard<std::recursive_mutex> alone{mutex};

    static std::recursive_mutex mutex;
  };

  /**
   * Let Python handle signals; throws what its handlers raise. Called while Computing;
   * solves call it several times a second.
   */
  void check_signals();

  /** While this exists, SIGTERM and SIGUSR1 end a run after a step, as in the program.
   *  Afterwards Python's own handlers are restored. */
  class SignalsOfProgram
  {
  public:
    SignalsOfProgram();
    ~SignalsOfProgram();
    SignalsOfProgram(const SignalsOfProgram &)            = delete;
    SignalsOfProgram &operator=(const SignalsOfProgram &) = delete;

  private:
    struct sigaction terminate = {}, user = {}, file_size = {};
  };
} // namespace strait::python
