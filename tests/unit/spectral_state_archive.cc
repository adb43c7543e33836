// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/spectral/state_archive.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "temporary_folder.h"

namespace strait::test
{
  /** A checkpoint in a folder of its own, the same on all ranks, and what it stores. */
  class CheckpointFile : public testing::Test
  {
  protected:
    void
    SetUp() override
    {
      path = folder.path() + "/checkpoint";
    }

    /** Write or read items of all kinds, and more points than one message takes. */
    void
    transfer(StateArchive &archive)
    {
      archive.value(number);
      archive.value(count);
      archive.value(text);
      archive.value(texts);
      archive.value(numbers);
      archive.field(field, layout);
      archive.field(single, *layout);
      archive.field(absent, layout);
      archive.field(nothing, *layout);
    }

    void
    fill()
    {
      number  = -0.1;
      count   = 1L << 50;
      text    = std::string("a\0b", 3);
      texts   = {"", "x"};
      numbers = {1., 2e300};
      field   = SlabField(layout);
      single.resize(layout->n_local_points());
      for (std::size_t i = 0; i < field.size(); ++i)
        {
          const std::size_t global =
            i + static_cast<std::size_t>(layout->first_row()) * layout->grid().nx;
          field[i]  = 1. / (1. + static_cast<double>(global));
          single[i] = static_cast<float>(field[i]);
        }
    }

    void
    save()
    {
      StateArchive writer(path, MPI_COMM_WORLD, StateArchive::Access::write);
      transfer(writer);
      writer.commit();
    }

    TemporaryFolder          folder;
    std::string              path;
    SlabLayoutPtr            layout = make_layout({500, 301, 1., 1.}, MPI_COMM_WORLD);
    double                   number = 0;
    long                     count  = 0;
    std::string              text;
    std::vector<std::string> texts;
    std::vector<double>      numbers;
    SlabField                field, absent;
    std::vector<float>       single, nothing;
  };
} // namespace strait::test

using namespace strait;
using strait::test::CheckpointFile;

TEST_F(CheckpointFile, GivesBackWhatWasPut)
{
  fill();
  save();
  const SlabField          field_then  = field;
  const std::vector<float> single_then = single;
  number                               = 0;
  count                                = 0;
  text                                 = "other";
  texts                                = {"some"};
  numbers.clear();
  field = SlabField();
  single.clear();
  absent  = SlabField(layout);
  nothing = {1.F};
  StateArchive reader(path, MPI_COMM_WORLD, StateArchive::Access::read);
  transfer(reader);
  EXPECT_EQ(number, -0.1);
  EXPECT_EQ(count, 1L << 50);
  EXPECT_EQ(text, std::string("a\0b", 3));
  EXPECT_EQ(texts, (std::vector<std::string>{"", "x"}));
  EXPECT_EQ(numbers, (std::vector<double>{1., 2e300}));
  ASSERT_EQ(field.size(), field_then.size());
  for (std::size_t i = 0; i < field.size(); ++i)
    ASSERT_EQ(field[i], field_then[i]);
  EXPECT_EQ(single, single_then);
  EXPECT_TRUE(absent.empty());
  EXPECT_TRUE(nothing.empty());
  // Nothing is left to read.
  EXPECT_THROW(reader.value(number), InputError);
}

TEST_F(CheckpointFile, AnotherGridIsRefused)
{
  fill();
  save();
  layout = make_layout({500, 300, 1., 1.}, MPI_COMM_WORLD);
  StateArchive reader(path, MPI_COMM_WORLD, StateArchive::Access::read);
  EXPECT_THROW(transfer(reader), InputError);
}

TEST_F(CheckpointFile, SpoiltFilesAreRefused)
{
  EXPECT_THROW(StateArchive(path, MPI_COMM_WORLD, StateArchive::Access::read),
               InputError);
  EXPECT_THROW(StateArchive(folder.path(), MPI_COMM_WORLD, StateArchive::Access::read),
               InputError);
  fill();
  save();
  const auto size = std::filesystem::file_size(path);
  MPI_Barrier(MPI_COMM_WORLD);
  for (const auto length : {size - 1, size / 2, std::uintmax_t(40), std::uintmax_t(0)})
    {
      run_on_root(MPI_COMM_WORLD, [&]() { std::filesystem::resize_file(path, length); });
      EXPECT_THROW(StateArchive(path, MPI_COMM_WORLD, StateArchive::Access::read),
                   InputError)
        << length;
    }
  for (const std::uintmax_t at : {std::uintmax_t(0), size / 3, size - 20, size - 1})
    {
      save();
      run_on_root(MPI_COMM_WORLD, [&]() {
        std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
        file.seekg(static_cast<std::streamoff>(at));
        const int byte = file.get();
        file.seekp(static_cast<std::streamoff>(at));
        file.put(static_cast<char>(byte ^ 4));
      });
      EXPECT_THROW(StateArchive(path, MPI_COMM_WORLD, StateArchive::Access::read),
                   InputError)
        << at;
    }
}

// All ranks hold the values in windows, but only their part of those at grid points.
TEST_F(CheckpointFile, KeepsTheWindowsOfAField)
{
  layout                                = make_layout({48, 31, 1., 1.}, MPI_COMM_WORLD);
  const std::vector<ZoomWindow> windows = {{-1, 1, 40, -3, 14, 12}, {0, 2, 5, 9, 12, 8}};
  const SlabLayoutPtr           zoomed  = with_windows(*layout, windows);
  const auto                    height  = [](const double x, const double y) {
    return 1. / (3. + x + 7 * y);
  };
  field                      = sample(zoomed, height);
  const auto transfer_fields = [&](StateArchive &archive) {
    archive.value(number);
    archive.field(field, layout);
    archive.field(single, field.layout());
    archive.value(count);
  };
  number = 3.;
  count  = 17;
  single.assign(field.begin(), field.end());
  const std::vector<float> single_then = single;
  {
    StateArchive writer(path, MPI_COMM_WORLD, StateArchive::Access::write);
    transfer_fields(writer);
    writer.commit();
  }
  const SlabField field_then = field;
  number                     = 0;
  count                      = 0;
  field                      = SlabField();
  single.clear();
  StateArchive reader(path, MPI_COMM_WORLD, StateArchive::Access::read);
  transfer_fields(reader);
  EXPECT_EQ(number, 3.);
  EXPECT_EQ(count, 17);
  EXPECT_TRUE(field.layout().windows() == windows);
  ASSERT_EQ(field.size(), field_then.size());
  for (std::size_t i = 0; i < field.size(); ++i)
    ASSERT_EQ(field[i], field_then[i]) << i;
  EXPECT_EQ(single, single_then);
}

// Warnings, for example, may be known to rank 0 only.
TEST_F(CheckpointFile, ListsAreThoseOfRankZero)
{
  if (layout->rank() == 0)
    texts = {"some", "more", ""};
  {
    StateArchive writer(path, MPI_COMM_WORLD, StateArchive::Access::write);
    writer.value(texts);
    field = SlabField(layout, 2.);
    writer.field(field, layout);
    writer.commit();
  }
  texts.clear();
  StateArchive reader(path, MPI_COMM_WORLD, StateArchive::Access::read);
  reader.value(texts);
  reader.field(field, layout);
  EXPECT_EQ(texts, (std::vector<std::string>{"some", "more", ""}));
  EXPECT_EQ(mean(field), 2.);
}

TEST_F(CheckpointFile, WhatIsNotCommittedChangesNothing)
{
  fill();
  save();
  {
    StateArchive writer(path, MPI_COMM_WORLD, StateArchive::Access::write);
    number = 7;
    writer.value(number);
  }
  StateArchive reader(path, MPI_COMM_WORLD, StateArchive::Access::read);
  transfer(reader);
  EXPECT_EQ(number, -0.1);
  run_on_root(MPI_COMM_WORLD,
              [this]() { EXPECT_FALSE(std::filesystem::exists(path + ".new")); });
  path = folder.path() + "/missing/checkpoint";
  EXPECT_THROW(save(), ComputationError);
}
