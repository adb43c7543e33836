// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/scene.h>
#include <strait/base/scene_text.h>
#include <strait/surface/readers/formats.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

using namespace strait;

// What libFuzzer calls, or driver.cc where there is none. The environment variable
// STRAIT_FUZZ_READER says which reader is meant: scene, npy, text, ...; the file
// fuzz-READER.input in the current folder holds the last input.
//
// A reader may accept its input or throw an InputError. All else is a bug: another
// exception, such as std::bad_alloc, or an error of a sanitizer; but in a process that
// reads apart, an error of the library for whose sake it does is none of ours.

// 2: also where a handler is reset, as that process does, so that a crash leaves a
// report.
extern "C" const char *
__asan_default_options()
{
  return "max_allocation_size_mb=512:allocator_may_return_null=1:detect_leaks=0:"
         "handle_segv=2:handle_sigbus=2:handle_sigfpe=2:handle_sigill=2:handle_abort=2";
}

// The libraries read and copy out of bounds in damaged files; not ours to mend.
extern "C" const char *
__asan_default_suppressions()
{
  return "interceptor_via_lib:libhdf5\ninterceptor_via_lib:libnetcdf\n";
}

namespace
{
  const std::map<std::string, MapFormat> formats = {{"npy", MapFormat::npy},
                                                    {"text", MapFormat::text},
                                                    {"xyz", MapFormat::xyz},
                                                    {"netcdf", MapFormat::netcdf},
                                                    {"hdf5", MapFormat::hdf5},
                                                    {"x3p", MapFormat::x3p},
                                                    {"sdf", MapFormat::sdf},
                                                    {"any", MapFormat::by_content}};

  std::string
  name_of_reader()
  {
    const char *name = std::getenv("STRAIT_FUZZ_READER");
    return name == nullptr ? "any" : name;
  }

  /** Whether it was HDF5 or NetCDF that came to grief, rather than strait: of the frames
   *  of a sanitizer's report the innermost of theirs or ours tells. Where a library took
   *  all memory that it is allowed, the sanitizer itself has none left for a report. */
  bool
  is_of_library(const std::string &report)
  {
    if (report.find("ERROR: AddressSanitizer failed to allocate") != std::string::npos)
      return true;
    std::istringstream lines(report);
    for (std::string line; std::getline(lines, line);)
      {
        const auto names = [&](const char *part) {
          return line.find(part) != std::string::npos;
        };
        if (line.compare(0, 5, "    #") != 0)
          continue;
        if (names("/libhdf5") || names("/libnetcdf"))
          return true;
        if (names("source/"))
          return false;
      }
    return false;
  }
} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const std::string reader = name_of_reader();
  static const std::string file   = "fuzz-" + reader + ".input";
  const std::string        content(reinterpret_cast<const char *>(data), size);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
  try
    {
      if (reader == "scene")
        make_scene(lex_scene(content, "scene.prm", "/")).warnings();
      else
        read_height_map({file, formats.at(reader)});
    }
  catch (const InputError &)
    {
    }
  catch (const ComputationError &error)
    {
      if (!is_of_library(error.what()))
        throw;
    }
  return 0;
}
