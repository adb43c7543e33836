// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace strait
{
  /** The version of this program, "major.minor.patch". */
  extern const std::string version;

  /** The Python interpreter that was found when the program was configured. */
  extern const std::string python_interpreter;

  /** The path of a script that the program calls at run time, such as "plot.py". The
   *  first of these folders that has it is taken: share/strait beside the executable's
   *  folder, the installed folder, tools/ of the source tree. Empty if none has it. */
  std::string find_script(const std::string &name);
} // namespace strait
