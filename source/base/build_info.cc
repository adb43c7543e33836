// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>

#include <filesystem>

namespace strait
{
  const std::string version            = STRAIT_VERSION;
  const std::string python_interpreter = STRAIT_PYTHON;

  std::string
  find_script(const std::string &name)
  {
    namespace fs = std::filesystem;
    std::error_code ignored; // a system without /proc is no error
    const fs::path  executable = fs::read_symlink("/proc/self/exe", ignored);
    for (const fs::path &folder : {executable.parent_path() / ".." / "share" / "strait",
                                   fs::path(STRAIT_INSTALLED_TOOLS),
                                   fs::path(STRAIT_SOURCE_TOOLS)})
      if (folder.is_absolute() && fs::exists(folder / name, ignored))
        return (folder / name).lexically_normal().string();
    return {};
  }
} // namespace strait
