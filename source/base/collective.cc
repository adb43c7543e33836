// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>

#include <new>

namespace strait
{
  namespace
  {
    enum class Outcome : int
    {
      fine,
      input_error,
      computation_error
    };

    [[noreturn]] void
    raise(const Outcome outcome, const std::string &message)
    {
      if (outcome == Outcome::input_error)
        throw InputError(message);
      throw ComputationError(message);
    }

    double
    reduce(MPI_Comm comm, double value, MPI_Op operation)
    {
      MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, comm);
      return value;
    }
  } // namespace

  std::string
  broadcast(MPI_Comm comm, std::string text)
  {
    unsigned long long length = text.size();
    MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
    text.resize(length);
    MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, comm);
    return text;
  }

  void
  run_on_root(MPI_Comm comm, const std::function<void()> &action)
  {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    Outcome     outcome = Outcome::fine;
    std::string message;
    if (rank == 0)
      {
        try
          {
            action();
          }
        catch (const InputError &error)
          {
            outcome = Outcome::input_error;
            message = error.what();
          }
        catch (const std::bad_alloc &)
          {
            outcome = Outcome::computation_error;
            message = "The memory of this machine does not suffice on rank 0.";
          }
        catch (const std::exception &error)
          {
            outcome = Outcome::computation_error;
            message = error.what();
          }
        catch (...)
          {
            outcome = Outcome::computation_error;
            message = "A library failed without saying why.";
          }
      }
    int code = static_cast<int>(outcome);
    MPI_Bcast(&code, 1, MPI_INT, 0, comm);
    outcome = static_cast<Outcome>(code);
    if (outcome != Outcome::fine)
      raise(outcome, broadcast(comm, message));
  }

  void
  throw_if_any(MPI_Comm comm, const std::string &error)
  {
    int rank = 0, n_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &n_ranks);
    int first = error.empty() ? n_ranks : rank;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm);
    if (first == n_ranks)
      return;
    unsigned long long length = error.size();
    MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, first, comm);
    std::string message = error;
    message.resize(length);
    MPI_Bcast(message.data(), static_cast<int>(length), MPI_CHAR, first, comm);
    throw InputError(message);
  }

  double
  sum(MPI_Comm comm, const double value)
  {
    return reduce(comm, value, MPI_SUM);
  }

  double
  maximum(MPI_Comm comm, const double value)
  {
    return reduce(comm, value, MPI_MAX);
  }

  double
  minimum(MPI_Comm comm, const double value)
  {
    return reduce(comm, value, MPI_MIN);
  }

  long long
  sum(MPI_Comm comm, long long value)
  {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_LONG_LONG, MPI_SUM, comm);
    return value;
  }

  void
  sum_in_place(MPI_Comm comm, double *values, const int count)
  {
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, comm);
  }
} // namespace strait
