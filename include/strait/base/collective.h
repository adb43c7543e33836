// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  /** The number of this rank in @p comm. */
  inline int
  rank_in(MPI_Comm comm)
  {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
  }

  /** The number of ranks in @p comm. */
  inline int
  n_ranks_in(MPI_Comm comm)
  {
    int n_ranks = 1;
    MPI_Comm_size(comm, &n_ranks);
    return n_ranks;
  }

  /**
   * Run @p program and return its exit status. If it throws, print one sentence on
   * standard error and return 2 for an InputError, 3 for an Interruption, 1 for anything
   * else.
   *
   * If all ranks of @p comm fail, rank 0 prints for them. If only some fail, the others
   * would wait for them for ever: after a few seconds each rank that failed prints its
   * sentence with its number, and aborts all ranks with the same status.
   */
  int with_clear_exit(MPI_Comm comm, const std::function<int()> &program);

  /** Collective: run @p action on rank 0 only. If it throws, every rank of @p comm throws
   *  with the same message: InputError for an InputError, else ComputationError. An error
   *  on rank 0 thus does not leave the other ranks hanging. */
  void run_on_root(MPI_Comm comm, const std::function<void()> &action);

  /** Collective: if @p error is not empty on some rank, every rank throws an InputError
   *  with the message of the lowest such rank. */
  void throw_if_any(MPI_Comm comm, const std::string &error);

  /** Collective: return the @p text of rank @p root on every rank. */
  std::string broadcast(MPI_Comm comm, std::string text, int root = 0);

  /** Collective: replace each of @p count values by its sum over all ranks, with one
   *  message. */
  template <typename Number>
  void
  sum_in_place(MPI_Comm comm, Number *values, const std::size_t count)
  {
    static_assert(std::is_same_v<Number, double> || std::is_same_v<Number, float> ||
                  std::is_same_v<Number, long long>);
    MPI_Datatype type = std::is_same_v<Number, double>  ? MPI_DOUBLE
                        : std::is_same_v<Number, float> ? MPI_FLOAT
                                                        : MPI_LONG_LONG;
    MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), type, MPI_SUM, comm);
  }

  /** Collective: replace each value of a container by its sum over all ranks. */
  template <typename Values>
  void
  sum_in_place(MPI_Comm comm, Values &values)
  {
    sum_in_place(comm, values.data(), values.size());
  }

  /** The sum of @p value over all ranks. Collective. */
  template <typename Number>
  Number
  sum(MPI_Comm comm, Number value)
  {
    sum_in_place(comm, &value, 1);
    return value;
  }

  /** The largest @p value on any rank. Collective. */
  inline double
  maximum(MPI_Comm comm, double value)
  {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm);
    return value;
  }

  /** The smallest @p value on any rank. Collective. */
  inline double
  minimum(MPI_Comm comm, const double value)
  {
    return -maximum(comm, -value);
  }

  /** Collective: return the items of all ranks, in the order of the ranks, on every rank.
   *  They are sent as bytes. */
  template <typename Item>
  std::vector<Item>
  gather_all(MPI_Comm comm, const std::vector<Item> &mine)
  {
    static_assert(std::is_trivially_copyable<Item>::value, "is sent as bytes");
    const int        n_ranks = n_ranks_in(comm), n = static_cast<int>(mine.size());
    std::vector<int> counts(n_ranks), starts(n_ranks + 1, 0);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    std::vector<Item> all(starts.back());
    MPI_Datatype      type; // to count items: the number of bytes may overflow an int
    MPI_Type_contiguous(sizeof(Item), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    MPI_Allgatherv(
      mine.data(), n, type, all.data(), counts.data(), starts.data(), type, comm);
    MPI_Type_free(&type);
    return all;
  }

  /** The items that a rank gets from all ranks, in the order of the ranks. */
  template <typename Item>
  struct ReceivedItems
  {
    std::vector<Item> items;
    std::vector<int>  counts; // units of items from each rank
  };

  /** Collective: send @p counts[r] units of @p unit items each to rank r, and return what
   *  the ranks sent to this one. @p items are in the order of the ranks, and are sent as
   *  bytes. Units keep the counts small. */
  template <typename Item>
  ReceivedItems<Item>
  exchange(MPI_Comm                 comm,
           const std::vector<Item> &items,
           const std::vector<int>  &counts,
           const int                unit = 1)
  {
    static_assert(std::is_trivially_copyable<Item>::value, "is sent as bytes");
    const std::size_t   n_ranks = counts.size();
    ReceivedItems<Item> received{{}, std::vector<int>(n_ranks)};
    MPI_Alltoall(counts.data(), 1, MPI_INT, received.counts.data(), 1, MPI_INT, comm);
    std::vector<int> to(n_ranks + 1), from(n_ranks + 1);
    std::partial_sum(counts.begin(), counts.end(), to.begin() + 1);
    std::partial_sum(received.counts.begin(), received.counts.end(), from.begin() + 1);
    received.items.resize(static_cast<std::size_t>(from.back()) * unit);
    MPI_Datatype type;
    MPI_Type_contiguous(unit * static_cast<int>(sizeof(Item)), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    MPI_Alltoallv(items.data(),
                  counts.data(),
                  to.data(),
                  type,
                  received.items.data(),
                  received.counts.data(),
                  from.data(),
                  type,
                  comm);
    MPI_Type_free(&type);
    return received;
  }
} // namespace strait
