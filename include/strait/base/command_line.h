// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace strait
{
  /** What the user asked for: "strait [options] SCENE.prm". */
  struct CommandLine
  {
    std::string              scene;     // path; empty only if no scene is needed
    std::vector<std::string> overrides; // "Section/Parameter=value"; --output comes last
    std::string              text;   // option that prints a text, e.g. --help; or empty
    std::string              format; // of that text, e.g. "md"; or empty
    bool                     resume  = false;
    bool                     force   = false;
    bool                     dry_run = false;
    bool                     quiet   = false;
  };

  /** Read the arguments; argv[0] is skipped. A value follows its option or an equals sign
   *  (--output DIR, --output=DIR). Throws InputError for an unknown option (naming the
   *  nearest one), a missing or needless value, no scene, two scenes, or a scene beside
   *  an option that prints a text. */
  CommandLine parse_command_line(int argc, const char *const *argv);

  /** The text of --help. */
  std::string help_text();

  /** The text of --scenes: the scenes that come with the program, each with the first
   *  clause of the comment at its head. Throws InputError if they are not found. */
  std::string list_of_scenes();
} // namespace strait
