// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/isolated_reader.h>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using namespace strait::test;

  using Reader = std::function<HeightMap()>;

  /** There is no such file, so the bounds are the least. */
  const IsolatedFile some_file("some.h5", "HDF5");

  std::string
  complaint(const Reader &read, const IsolatedFile &file = some_file)
  {
    return input_error([&]() { read_isolated(file, read); });
  }

  std::string
  failure(const Reader &read)
  {
    try
      {
        read_isolated(some_file, read);
      }
    catch (const ComputationError &error)
      {
        return error.what();
      }
    ADD_FAILURE() << "no ComputationError was thrown";
    return {};
  }

  HeightMap
  one_point()
  {
    HeightMap map;
    map.nx     = 1;
    map.ny     = 1;
    map.values = {2.};
    return map;
  }

  HeightMap
  large_map()
  {
    HeightMap map;
    map.nx = 300;
    map.ny = 200; // more than a pipe holds
    for (int i = 0; i < map.nx * map.ny; ++i)
      map.values.push_back(std::sqrt(i));
    map.values[7]    = NAN;
    map.size         = {{3., 2.}};
    map.lateral_unit = parse_length_unit("63.1 nm");
    map.height_unit  = parse_length_unit("furlong");
    map.is_periodic  = true;
    map.format       = "HDF5";
    return map;
  }

  TEST(IsolatedReader, HandsOverAWholeMap)
  {
    const HeightMap expected = large_map();
    const HeightMap map      = read_isolated(some_file, large_map);
    EXPECT_EQ(map.nx, expected.nx);
    EXPECT_EQ(map.ny, expected.ny);
    ASSERT_EQ(map.values.size(), expected.values.size());
    EXPECT_TRUE(std::isnan(map.values[7]));
    for (std::size_t i = 8; i < map.values.size(); ++i)
      ASSERT_EQ(map.values[i], expected.values[i]);
    EXPECT_EQ(map.size, expected.size);
    EXPECT_EQ(map.lateral_unit.name, "63.1 nm");
    EXPECT_EQ(map.lateral_unit.metres, expected.lateral_unit.metres);
    EXPECT_EQ(map.height_unit.name, "furlong");
    EXPECT_FALSE(map.height_unit.metres);
    EXPECT_TRUE(map.is_periodic);
    EXPECT_EQ(map.format, "HDF5");

    const HeightMap bare = read_isolated(some_file, []() { return one_point(); });
    EXPECT_EQ(bare.values, std::vector<double>{2.});
    EXPECT_FALSE(bare.size);
    EXPECT_FALSE(bare.lateral_unit.is_stated());
  }

  TEST(IsolatedReader, ErrorsOfTheReaderPassUnchanged)
  {
    EXPECT_EQ(complaint([]() -> HeightMap { throw InputError("Mend it."); }), "Mend it.");
    EXPECT_EQ(failure([]() -> HeightMap { throw std::runtime_error("odd"); }), "odd");
    EXPECT_TRUE(mentions(failure([]() -> HeightMap { throw 1; }), "without saying why"));
    EXPECT_THROW(read_isolated(some_file, []() -> HeightMap { throw std::bad_alloc(); }),
                 std::bad_alloc);
  }

  TEST(IsolatedReader, ACrashIsAnInputError)
  {
    // MPI and a sanitizer have handlers of their own.
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
      EXPECT_EQ(complaint([&]() {
                  raise(number);
                  return HeightMap();
                }),
                "The height map 'some.h5' is damaged: the HDF5 library failed to read "
                "it (signal " +
                  std::to_string(number) + "); copy or export it again.");
    EXPECT_TRUE(mentions(complaint([]() -> HeightMap { std::abort(); }), "signal 6"));
    EXPECT_TRUE(mentions(failure([]() {
                           raise(SIGKILL);
                           return HeightMap();
                         }),
                         "memory of this machine"));
  }

  TEST(IsolatedReader, ALoopIsAnInputError)
  {
    IsolatedFile file = some_file;
    file.seconds      = 1;
    const auto loop   = []() {
      for (volatile int i = 0;;)
        i = 1 - i;
      return HeightMap();
    };
    EXPECT_TRUE(
      mentions(complaint(loop, file), "HDF5 library was still reading it after 1 s"));
  }

  TEST(IsolatedReader, MemoryIsBounded)
  {
    // A sanitizer would end the process if its own malloc failed.
    const auto greed = []() {
      if (mmap(nullptr,
               1U << 29,
               PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS,
               -1,
               0) == MAP_FAILED)
        throw InputError("No more.");
      return one_point();
    };
    IsolatedFile file = some_file;
    file.memory       = 1U << 28;
    EXPECT_EQ(complaint(greed, file), "No more.");
    file.memory = 1U << 30;
    EXPECT_EQ(read_isolated(file, greed).nx, 1);
  }

  TEST(IsolatedReader, AMapThatIsNoneIsAnInputError)
  {
    const auto nonsense = []() {
      HeightMap map = one_point();
      map.nx        = 2;
      return map;
    };
    EXPECT_TRUE(mentions(complaint(nonsense), "library failed to read it"));
  }

  TEST(IsolatedReader, AnExitTellsWhatWasPrinted)
  {
    const std::string message = failure([]() -> HeightMap {
      if (write(STDERR_FILENO, "overflow", 8) != 8)
        _exit(1);
      _exit(23);
    });
    EXPECT_TRUE(mentions(message, "status 23. overflow"));
  }

  TEST(IsolatedReader, TheChildLeavesThisProcessAlone)
  {
    // What waits in a buffer must not be written by both.
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    std::FILE *buffered = fdopen(ends[1], "w");
    std::fputs("once", buffered);
    int touched = 0;
    read_isolated(some_file, [&]() {
      touched = 1;
      return one_point();
    });
    EXPECT_EQ(touched, 0);
    std::fclose(buffered);
    char content[16] = {};
    EXPECT_EQ(read(ends[0], content, sizeof content), 4);
    close(ends[0]);
  }

  TEST(IsolatedReader, RequestsToStopAreNotForTheChild)
  {
    for (const int number : {SIGINT, SIGTERM, SIGUSR1})
      EXPECT_EQ(read_isolated(some_file,
                              [&]() {
                                raise(number);
                                return one_point();
                              })
                  .nx,
                1);
  }

  TEST(IsolatedReader, WorksWhereChildrenAreNotReported)
  {
    auto *const earlier = std::signal(SIGCHLD, SIG_IGN);
    EXPECT_EQ(read_isolated(some_file, large_map).nx, 300);
    EXPECT_TRUE(mentions(complaint([]() -> HeightMap { std::abort(); }), "is damaged"));
    std::signal(SIGCHLD, earlier);
  }
} // namespace
