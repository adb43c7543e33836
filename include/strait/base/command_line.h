// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace strait
{
  /** What the user asked for: "strait [options] SCENE.prm". */
  struct CommandLine
  {
    std::string              scene;     // empty only if no scene is needed
    std::vector<std::string> overrides; // "Section/Parameter=value"; --output is the last
    std::string              text;      // the option that asks for something to read
    std::string              format;    // of that
    bool                     resume  = false;
    bool                     force   = false;
    bool                     dry_run = false;
    bool                     quiet   = false;
  };

  /** Read the arguments; argv[0] is skipped. Values follow their option or an equals sign
   *  (--output DIR, --output=DIR). Throws InputError for an unknown option (naming the
   *  nearest one), a missing value, no scene or two. */
  CommandLine parse_command_line(int argc, const char *const *argv);

  /** The text of --help. */
  std::string help_text();

  /** The scenes that come with the program, each with the first clause of the comment at
   *  its head. Throws InputError if they are not there. */
  std::string list_of_scenes();
} // namespace strait
