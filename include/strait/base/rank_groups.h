// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_rank_groups_h
#define strait_base_rank_groups_h

#include <mpi.h>

#include <vector>

namespace strait
{
  /** The ranks of MPI_COMM_WORLD in groups that work beside each other. */
  class RankGroups
  {
  public:
    /** Groups of @p ranks_each ranks; empty: one of all ranks. Throws InputError if it
     * does not divide the number of ranks. Collective. */
    explicit RankGroups(const std::vector<int> &ranks_each);

    ~RankGroups();

    RankGroups(const RankGroups &)            = delete;
    RankGroups &operator=(const RankGroups &) = delete;

    /** The first rank of group @p group. */
    int
    root_of(const int group) const
    {
      return group * n_each;
    }

    int      number = 1;             // of groups
    int      mine   = 0;             // the group of this rank
    MPI_Comm comm   = MPI_COMM_NULL; // of this rank's group

  private:
    int n_each = 1;
  };
} // namespace strait

#endif
