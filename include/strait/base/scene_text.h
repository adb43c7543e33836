// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace strait
{
  /** One "set NAME = VALUE" of a scene, or the start of a subsection. */
  struct SceneEntry
  {
    std::string section; // "Section/Subsection"
    std::string name;    // empty: the section starts here
    std::string value;   // without comment
    std::string place;   // "FILE:LINE" or "--set ...", for messages
    std::string folder;  // relative paths in the value start here

    /** "Section/Subsection/Name"; "Name" outside every section. */
    std::string
    path() const
    {
      return section.empty() ? name : section + "/" + name;
    }
  };

  /** The entries of a scene file, in its order. It has lines with subsection, set or end,
   *  comments (#) and continued lines (\). Throws InputError for any other line, an "end"
   *  too many or too few, a parameter that is set twice, a subsection with a '/' in its
   *  name, or more than 16 subsections within each other. */
  std::vector<SceneEntry>
  lex_scene(const std::string &text, const std::string &file, const std::string &folder);

  /** The entry of an override "Section/Parameter=value" or
   *  "Section/Subsection/Parameter=value". Throws InputError for another form. */
  SceneEntry lex_override(const std::string &text, const std::string &folder);
} // namespace strait
