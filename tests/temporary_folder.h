// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/base/exceptions.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace strait::test
{
  /** A folder that exists, for all ranks, as long as this object does. Collective. */
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      run_on_root(MPI_COMM_WORLD, [this]() {
        // mkdtemp() replaces the six X by characters that make the name unique.
        folder = (std::filesystem::temp_directory_path() / "strait-XXXXXX").string();
        if (mkdtemp(folder.data()) == nullptr)
          throw ComputationError("There is no room for a folder '" + folder + "'.");
      });
      folder = broadcast(MPI_COMM_WORLD, folder);
    }

    ~TemporaryFolder()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (rank_in(MPI_COMM_WORLD) == 0)
        std::filesystem::remove_all(folder);
    }

    TemporaryFolder(const TemporaryFolder &)            = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    const std::string &
    path() const
    {
      return folder;
    }

  private:
    std::string folder;
  };
} // namespace strait::test
