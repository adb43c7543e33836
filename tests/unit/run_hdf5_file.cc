// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/run/hdf5_file.h>

#include <deal.II/base/hdf5.h>

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace
{
  using namespace strait;

  /** The error of writing the file @p path with @p write; empty if there is none. */
  std::string
  error_of(const std::string                               &path,
           const std::function<void(dealii::HDF5::File &)> &write)
  {
    try
      {
        write_hdf5_file(path, MPI_COMM_WORLD, write);
      }
    catch (const ComputationError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(Hdf5File, CanBeReadAgain)
{
  const test::TemporaryFolder folder;
  EXPECT_EQ(error_of(folder.path() + "/good.h5",
                     [](dealii::HDF5::File &file) { file.set_attribute("lx", 2.5); }),
            "");
  run_on_root(MPI_COMM_WORLD, [&]() {
    dealii::HDF5::File file(folder.path() + "/good.h5",
                            dealii::HDF5::File::FileAccessMode::open);
    EXPECT_EQ(file.get_attribute<double>("lx"), 2.5);
  });
}

TEST(Hdf5File, ThatCannotBeCreatedIsAnError)
{
  const test::TemporaryFolder folder;
  const std::string           error =
    error_of(folder.path() + "/missing/fields.h5",
             [](dealii::HDF5::File &file) { file.set_attribute("lx", 2.5); });
  EXPECT_NE(error.find("/missing/fields.h5' could not be written (HDF5: "),
            std::string::npos)
    << error;
}

TEST(Hdf5File, WithAGroupThatExistsIsAnError)
{
  const test::TemporaryFolder folder;
  EXPECT_NE(error_of(folder.path() + "/twice.h5",
                     [](dealii::HDF5::File &file) {
                       file.create_group("window-1");
                       file.create_group("window-1");
                     }),
            "");
  // A failure is not remembered.
  EXPECT_EQ(error_of(folder.path() + "/after.h5", [](dealii::HDF5::File &) {}), "");
}
