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

    /** How many groups there are. */
    int
    number() const
    {
      return n_groups;
    }

    /** The group of this rank. */
    int
    mine() const
    {
      return my_group;
    }

    /** Of this rank's group. */
    MPI_Comm
    communicator() const
    {
      return comm;
    }

    /** The first rank of group @p group. */
    int
    root_of(const int group) const
    {
      return group * n_each;
    }

  private:
    int      n_each   = 1;
    int      n_groups = 1;
    int      my_group = 0;
    MPI_Comm comm     = MPI_COMM_NULL;
  };
} // namespace strait

#endif
