// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/table.h>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "temporary_folder.h"

namespace
{
  using namespace strait;

  struct Row
  {
    int    step;
    double value;
  };

  std::string
  text_in(const std::string &path)
  {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  Table<Row>
  table_of_rows()
  {
    Table<Row> table("table.csv", {"", true}, "for a test");
    table.add(&Row::step, "step [1]: number");
    table.add(&Row::value, "value [1]: number");
    return table;
  }

  // Later rows are not lost if an editor, on saving, replaces the file by renaming
  // another one, or if the file is removed.
  TEST(Table, GoesOnInTheFileOfItsName)
  {
    const test::TemporaryFolder folder;
    run_on_root(MPI_COMM_WORLD, [&]() {
      const std::string path  = folder.path() + "/table.csv";
      Table<Row>        table = table_of_rows();
      std::ofstream(path) << "of an earlier run\n";
      table.write_rows(folder.path(), {{1, .5}});
      std::filesystem::copy(path, path + ".saved");
      std::filesystem::rename(path + ".saved", path);
      table.append({2, .25});
      EXPECT_EQ(text_in(path), "step,value\n1,0.5\n2,0.25\n");
      std::filesystem::remove(path);
      table.append({3, .125});
      EXPECT_EQ(text_in(path), "step,value\n3,0.125\n");
      Table<Row> again = table;
      again.open(folder.path());
      again.append({4, 1.});
      EXPECT_EQ(text_in(path), "step,value\n3,0.125\n4,1\n");
    });
  }

  TEST(Table, LeavesNoFileWhoseHeaderDidNotFit)
  {
    const test::TemporaryFolder folder;
    run_on_root(MPI_COMM_WORLD, [&]() {
      const std::string path  = folder.path() + "/table.csv";
      Table<Row>        table = table_of_rows();
      rlimit            before{};
      getrlimit(RLIMIT_FSIZE, &before);
      const auto   default_action = std::signal(SIGXFSZ, SIG_IGN);
      const rlimit no_room        = {2, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &no_room);
      EXPECT_THROW(table.open(folder.path()), ComputationError);
      setrlimit(RLIMIT_FSIZE, &before);
      std::signal(SIGXFSZ, default_action);
      EXPECT_FALSE(std::filesystem::exists(path));
      table.open(folder.path());
      table.append({1, 0.});
      EXPECT_EQ(text_in(path), "step,value\n1,0\n");
    });
  }
} // namespace
