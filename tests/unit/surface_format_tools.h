// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_tests_unit_surface_format_tools_h
#define strait_tests_unit_surface_format_tools_h

#include <strait/surface/readers/formats.h>

#include <functional>
#include <sstream>

#include "surface_test_tools.h"

namespace strait::test
{
  /** A file that a library writes: reserved as an empty one, then filled by rank 0. */
  class WrittenFile : public TemporaryFile
  {
  public:
    explicit WrittenFile(const std::function<void(const std::string &)> &write)
      : TemporaryFile("")
    {
      run_on_root(MPI_COMM_WORLD, [&]() {
        std::filesystem::remove(path);
        write(path);
      });
    }
  };

  inline HeightMap
  read(const TemporaryFile &file, const std::string &dataset = "")
  {
    return read_height_map({file.path, MapFormat::by_content, dataset});
  }

  inline std::string
  complaint(const TemporaryFile &file, const std::string &dataset = "")
  {
    return input_error([&]() { read(file, dataset); });
  }

  inline std::string
  content_of(const TemporaryFile &file)
  {
    std::ifstream      stream(file.path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /** Cut at 10 … 90 % of its length a file must be refused, never crash. */
  inline void
  expect_refusal_when_cut(const TemporaryFile &file)
  {
    const std::string whole = content_of(file);
    for (int tenths = 1; tenths < 10; ++tenths)
      {
        const TemporaryFile cut(whole.substr(0, whole.size() * tenths / 10));
        EXPECT_FALSE(complaint(cut).empty()) << tenths;
      }
  }
} // namespace strait::test

#endif
