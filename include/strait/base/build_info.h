// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace strait
{
  /** The version of this program, "major.minor.patch". */
  extern const std::string version;

  /** The Python interpreter that was found when the program was configured. */
  extern const std::string python_interpreter;

  /** The path of a script that the program calls at run time, such as "plot.py": the
   *  first that exists of share/strait beside the executable's folder, the installed
   *  folder, and tools/ of the source tree. Empty if there is none. */
  std::string find_script(const std::string &name);
} // namespace strait
