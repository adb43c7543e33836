// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_tests_temporary_folder_h
#define strait_tests_temporary_folder_h

#include <strait/base/collective.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace strait::test
{
  /** A folder that is there on all ranks as long as this object is. Collective. */
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      run_on_root(MPI_COMM_WORLD, [this]() {
        folder = (std::filesystem::temp_directory_path() / "strait-XXXXXX").string();
        folder = mkdtemp(folder.data());
      });
      folder = broadcast(MPI_COMM_WORLD, folder);
    }

    ~TemporaryFolder()
    {
      int rank = 0;
      MPI_Barrier(MPI_COMM_WORLD);
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      if (rank == 0)
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

#endif
