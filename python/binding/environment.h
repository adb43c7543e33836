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
   * Start MPI and the libraries that deal.II needs, unless that was done before. Called
   * by whatever computes, so that to import the package costs nothing, and without
   * arguments, so that those of the script stay its own. An MPI that somebody else has
   * started, such as mpi4py, is used and left to its owner.
   */
  void start();

  /** Add something that must be freed before MPI ends, and what does so. */
  void free_at_exit(void *object, std::function<void()> free);

  /** It was freed in time. */
  void forget_at_exit(void *object);

  /** That of a communicator of mpi4py; all ranks if @p comm is None. Starts MPI. */
  MPI_Comm communicator_of(const py::object &comm);

  /**
   * While this exists other threads of Python run and this one computes. Only one at a
   * time does, for neither MPI nor the planner of FFTW can be shared. A handler of a
   * signal, or an object that it lets go, may compute again in the same thread.
   */
  class Computing
  {
    py::gil_scoped_release                released;
    std::lock_guard<std::recursive_mutex> alone{mutex};

    static std::recursive_mutex mutex;
  };

  /**
   * Let Python act on signals; throws what its handlers raise. While Computing. Solves do
   * so on the way, several times a second.
   */
  void check_signals();

  /** While this exists SIGTERM and SIGUSR1 are the program's, which ends a run after a
   *  step; then Python has them back. */
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
