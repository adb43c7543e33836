// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/rank_groups.h>
#include <strait/base/text.h>

namespace strait
{
  RankGroups::RankGroups(const std::vector<int> &ranks_each)
  {
    int my_rank = 0, n_ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &my_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    n_each = ranks_each.empty() ? n_ranks : ranks_each.front();
    if (n_ranks % n_each != 0)
      throw InputError(
        format("Realisations/Ranks each = %d does not divide the number of ranks, %d.",
               n_each,
               n_ranks));
    number = n_ranks / n_each;
    mine   = my_rank / n_each;
    MPI_Comm_split(MPI_COMM_WORLD, mine, my_rank, &comm);
  }

  RankGroups::~RankGroups()
  {
    MPI_Comm_free(&comm);
  }
} // namespace strait
