// SPDX-License-Identifier: GPL-2.0-or-later
#include "environment.h"

#include <strait/base/collective.h>
#include <strait/base/signals.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector_memory.h>

#include <p4est.h>
#include <sc.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <memory>

namespace strait::python
{
  namespace
  {
    /** MPI and deal.II as started here; empty if MPI was already running. */
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> own_mpi;

    std::map<void *, std::function<void()>> &
    live_objects()
    {
      static std::map<void *, std::function<void()>> objects;
      return objects;
    }

    /** Restores the handlers of signals, which the libraries that start with MPI set. */
    class KeptHandlers
    {
    public:
      KeptHandlers()
      {
        for (std::size_t n = 1; n < handlers.size(); ++n)
          sigaction(static_cast<int>(n), nullptr, &handlers[n]);
      }

      ~KeptHandlers()
      {
        for (std::size_t n = 1; n < handlers.size(); ++n)
          sigaction(static_cast<int>(n), &handlers[n], nullptr);
      }

      KeptHandlers(const KeptHandlers &)            = delete;
      KeptHandlers &operator=(const KeptHandlers &) = delete;

    private:
      std::array<struct sigaction, 32> handlers{}; // those of POSIX have smaller numbers
    };

    /** If MPI is already running: do the rest of what MPI_InitFinalize does. */
    void
    join_mpi()
    {
      sc_init(MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_SILENT);
      p4est_init(nullptr, SC_LP_SILENT);
      dealii::MultithreadInfo::set_thread_limit(1);
    }

    /** Undo join_mpi(). Vectors that are kept for later use refer to communicators. */
    void
    leave_mpi()
    {
      using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
      dealii::GrowingVectorMemory<Vector>::release_unused_memory();
      dealii::GrowingVectorMemory<
        dealii::TrilinosWrappers::MPI::Vector>::release_unused_memory();
      sc_finalize();
    }

    /** End all ranks unless @p status is 0: others may wait forever for a failed one. */
    void
    end_others(const int status)
    {
      if (status != 0 && n_ranks_in(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, status);
    }

    /** At most ten times a second, because other threads of Python must pause for it. */
    void
    check_signals_on_the_way()
    {
      using Clock = std::chrono::steady_clock;
      static Clock::time_point next;
      if (Clock::now() < next)
        return;
      next = Clock::now() + std::chrono::milliseconds(100);
      check_signals();
    }

    void
    stop()
    {
      at_interruption_points = {};
      end_others(py::hasattr(py::module_::import("sys"), "last_type") ? 1 : 0);
      for (const auto &object : live_objects())
        object.second();
      live_objects().clear();
      if (!own_mpi)
        leave_mpi();
    }

    /** Called after the end of Python, as stop() does not learn of sys.exit(). */
    void
    stop_own_mpi(const int status, void *)
    {
      end_others(status);
      own_mpi.reset();
    }
  } // namespace

  std::recursive_mutex Computing::mutex;

  void
  start()
  {
    static bool is_started = false;
    if (is_started)
      return;
    is_started     = true;
    int is_running = 0;
    MPI_Initialized(&is_running);
    if (is_running != 0)
      join_mpi();
    else
      {
        const KeptHandlers kept;
        int                argc = 0;
        char             **argv = nullptr;
        own_mpi =
          std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
        on_exit(&stop_own_mpi, nullptr);
      }
    at_interruption_points = check_signals_on_the_way;
    py::module_::import("atexit").attr("register")(py::cpp_function(&stop));
  }

  void
  free_at_exit(void *object, std::function<void()> free)
  {
    live_objects()[object] = std::move(free);
  }

  void
  forget_at_exit(void *object)
  {
    live_objects().erase(object);
  }

  MPI_Comm
  communicator_of(const py::object &comm)
  {
    start();
    if (comm.is_none())
      return MPI_COMM_WORLD;
    return MPI_Comm_f2c(comm.attr("py2f")().cast<MPI_Fint>());
  }

  void
  check_signals()
  {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
  }

  SignalsOfProgram::SignalsOfProgram()
  {
    struct sigaction interrupt = {};
    sigaction(SIGINT, nullptr, &interrupt);
    sigaction(SIGTERM, nullptr, &terminate);
    sigaction(SIGUSR1, nullptr, &user);
    sigaction(SIGXFSZ, nullptr, &file_size);
    catch_signals();
    sigaction(SIGINT, &interrupt, nullptr);
  }

  SignalsOfProgram::~SignalsOfProgram()
  {
    sigaction(SIGTERM, &terminate, nullptr);
    sigaction(SIGUSR1, &user, nullptr);
    sigaction(SIGXFSZ, &file_size, nullptr);
  }
} // namespace strait::python
