// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>
#include <strait/base/exceptions.h>
#include <strait/base/scene.h>
#include <strait/base/scene_text.h>
#include <strait/surface/readers/height_map.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

using namespace strait;

// The function that libFuzzer calls, or driver.cc without it. The environment variable
// STRAIT_FUZZ_READER names the reader: scene, or a kind of height map, which is told by
// its content. The file fuzz-READER.input in the current folder holds the last input.
//
// A reader may accept its input or throw an InputError. Anything else is a bug: another
// exception, such as std::bad_alloc, or an error of a sanitizer.

extern "C" const char *
__asan_default_options()
{
  return "max_allocation_size_mb=512:allocator_may_return_null=1:detect_leaks=0";
}

// Replaces the function of build_info.cc, which is not compiled in: there are no scripts.
std::string
strait::find_script(const std::string & /*name*/)
{
  return {};
}

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const char       *named  = std::getenv("STRAIT_FUZZ_READER");
  static const std::string reader = named == nullptr ? "any" : named;
  static const std::string file   = "fuzz-" + reader + ".input";
  const std::string        content(reinterpret_cast<const char *>(data), size);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
  try
    {
      if (reader == "scene")
        make_scene(lex_scene(content, "scene.prm", "/")).warnings();
      else
        read_height_map(file);
    }
  catch (const InputError &)
    {
    }
  return 0;
}
