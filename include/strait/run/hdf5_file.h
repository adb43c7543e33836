// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace dealii
{
  namespace HDF5
  {
    class File;
  }
} // namespace dealii

namespace strait
{
  /**
   * Create the HDF5 file @p path and fill it with @p write. Collective on @p comm. Throws
   * ComputationError on all ranks, with what HDF5 says, if any of its calls fails on any
   * rank, also within deal.II, which does not look at what they return.
   *
   * One rank writes without MPI-IO, which would share files that Open MPI names after
   * @p path with other runs on the machine.
   */
  void write_hdf5_file(const std::string                               &path,
                       MPI_Comm                                         comm,
                       const std::function<void(dealii::HDF5::File &)> &write);
} // namespace strait
