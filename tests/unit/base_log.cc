// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/log.h>
#include <strait/base/timers.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "temporary_folder.h"

using namespace strait;

namespace
{
  bool
  on_root()
  {
    return rank_in(MPI_COMM_WORLD) == 0;
  }

  std::string
  contents(const std::string &path)
  {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
} // namespace

TEST(Log, FileBeginsWithTheLinesBeforeIt)
{
  const test::TemporaryFolder folder;
  const std::string           path = folder.path() + "/log.txt";
  std::ostringstream          screen;
  {
    Log log(MPI_COMM_WORLD, screen, Log::Screen::plain);
    log.line("one");
    log.warn("two");
    log.attach_file(path);
    log.line("three");
    EXPECT_EQ(log.warnings(), std::vector<std::string>{"two"});
  }
  const std::string expected = "one\nwarning: two\nthree\n";
  EXPECT_EQ(screen.str(), on_root() ? expected : "");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(contents(path), expected);
}

TEST(Log, SameWarningOnlyOnce)
{
  std::ostringstream screen;
  Log                log(MPI_COMM_WORLD, screen, Log::Screen::plain);
  log.warn("coarse");
  log.warn("coarse");
  EXPECT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(screen.str(), on_root() ? "warning: coarse\n" : "");
}

TEST(Log, LiveLineStaysBelowAllOthers)
{
  const std::string  clear = "\r\x1b[K";
  std::ostringstream screen;
  {
    Log log(MPI_COMM_WORLD, screen, Log::Screen::terminal);
    log.stage("step 1 of 2");
    log.progress("  10 %");
    log.line("step 1: leaks");
    log.stage("step 2 of 2");
    log.stage("");
    log.line("done");
    log.progress("  20 %");
  }
  EXPECT_EQ(screen.str(),
            on_root() ? "\rstep 1 of 2\x1b[K"
                        "\rstep 1 of 2  10 %\x1b[K" +
                          clear + "step 1: leaks\n\rstep 1 of 2  10 %\x1b[K" + clear +
                          "\rstep 2 of 2\x1b[K" + clear + "done\n\r  20 %\x1b[K" + clear
                      : "");
  std::ostringstream pipe;
  {
    Log log(MPI_COMM_WORLD, pipe, Log::Screen::plain);
    log.progress("10 %"); // too early after the start
    log.line("done");
  }
  EXPECT_EQ(pipe.str(), on_root() ? "done\n" : "");
}

TEST(Log, LinesFitATerminal)
{
  const std::string  sentence = "  step 3 of 7: leak rate 1.5e-9 ± 0.3 %, ";
  std::ostringstream screen, pipe;
  Log                log(MPI_COMM_WORLD, screen, Log::Screen::terminal);
  Log                plain(MPI_COMM_WORLD, pipe, Log::Screen::plain);
  const std::string  text =
    sentence + sentence + sentence + "\nshort\n" + std::string(99, 'x');
  log.line(text);
  plain.line(text);
  log.progress(std::string(99, '*'));
  if (!on_root())
    return;
  EXPECT_EQ(pipe.str(), text + "\n");
  EXPECT_EQ(
    screen.str(),
    "  step 3 of 7: leak rate 1.5e-9 ± 0.3 %,   step 3 of 7: leak rate 1.5e-9 ± 0.3\n"
    "      %,   step 3 of 7: leak rate 1.5e-9 ± 0.3 %, \n"
    "short\n" +
      std::string(99, 'x') + "\n\r" + std::string(79, '*') + "\x1b[K");
}

TEST(Log, QuietScreen)
{
  std::ostringstream screen;
  Log                log(MPI_COMM_WORLD, screen, Log::Screen::silent);
  log.line("one");
  log.progress("two");
  log.warn("three");
  EXPECT_EQ(screen.str(), "");
  EXPECT_EQ(log.warnings().size(), 1u);
}

TEST(Log, UnwritableFileIsAnErrorOnAllRanks)
{
  std::ostringstream screen;
  Log                log(MPI_COMM_WORLD, screen, Log::Screen::plain);
  EXPECT_THROW(log.attach_file("/no/such/folder/log.txt"), InputError);
}

TEST(Log, FullDiskIsNoFaultOfTheInput)
{
  std::ostringstream screen;
  Log                log(MPI_COMM_WORLD, screen, Log::Screen::plain);
  log.line("one");
  try
    {
      log.attach_file("/dev/full");
      FAIL() << "nothing was thrown";
    }
  catch (const ComputationError &error)
    {
      EXPECT_EQ(std::string(error.what()),
                "The log file '/dev/full' cannot be written (No space left on device); "
                "make room, and continue with --resume if the run had begun.");
    }
}

TEST(Timers, PartsNestAndTheRestIsOther)
{
  using namespace std::chrono_literals;
  Timers timers;
  for (int i = 0; i < 2; ++i)
    {
      const auto contact = timers.scope("contact");
      std::this_thread::sleep_for(2ms);
      const auto transforms = timers.scope("transforms");
      std::this_thread::sleep_for(4ms);
    }
  {
    const auto flow = timers.scope("flow");
  }
  const auto               table = timers.table();
  std::vector<std::string> paths;
  for (const auto &part : table)
    paths.push_back(part.path);
  EXPECT_EQ(
    paths,
    (std::vector<std::string>{
      "total", "contact", "contact/transforms", "contact/other", "flow", "other"}));
  EXPECT_GE(table[1].seconds, 0.012);
  EXPECT_GE(table[2].seconds, 0.008);
  EXPECT_EQ(table[2].depth, 2);
  EXPECT_NEAR(table[2].seconds + table[3].seconds, table[1].seconds, 1e-12);
  EXPECT_NEAR(table[1].seconds + table[4].seconds + table[5].seconds,
              table[0].seconds,
              1e-12);
  EXPECT_NE(timers.summary().find("    transforms"), std::string::npos);
}
