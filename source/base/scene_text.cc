// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/scene_text.h>
#include <strait/base/text.h>

#include <boost/algorithm/string.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <map>
#include <sstream>

namespace strait
{
  namespace
  {
    struct Line
    {
      std::string text;
      int         number;
    };

    /** The lines without comments; continued lines are joined, blank ones dropped. */
    std::vector<Line>
    logical_lines(const std::string &text)
    {
      std::vector<Line>  lines;
      std::istringstream in(text);
      bool               continued = false;
      std::string        raw;
      for (int number = 1; std::getline(in, raw); ++number)
        {
          std::string part = trim(raw.substr(0, raw.find('#')));
          const bool  open = !part.empty() && part.back() == '\\';
          if (open)
            part = trim(part.substr(0, part.size() - 1));
          if (continued)
            lines.back().text = trim(lines.back().text + " " + part);
          else if (!part.empty() || open)
            lines.push_back({part, number});
          continued = open;
        }
      return lines;
    }

    /** The first word in lower case, and the rest of the line. */
    std::pair<std::string, std::string>
    first_word(const std::string &line)
    {
      const auto end = line.find_first_of(" \t");
      return {boost::to_lower_copy(line.substr(0, end)),
              end == std::string::npos ? "" : trim(line.substr(end))};
    }

    /** A name with each run of white space inside it replaced by one blank. */
    std::string
    squeeze(const std::string &name)
    {
      return boost::trim_fill_copy(name, " ");
    }
  } // namespace

  std::vector<SceneEntry>
  lex_scene(const std::string &text, const std::string &file, const std::string &folder)
  {
    std::vector<SceneEntry>    entries;
    std::vector<std::string>   section;
    std::vector<std::string>   opened_at;
    std::map<std::string, int> lines_of_settings; // by path
    for (const Line &line : logical_lines(without_byte_order_mark(text)))
      {
        if (line.text.empty())
          continue;
        const std::string place = file + ":" + std::to_string(line.number);
        const auto [word, rest] = first_word(line.text);
        const auto equals       = rest.find('=');
        if (word == "subsection" && !rest.empty())
          {
            // Deeper than any scene. Each entry stores the names of all that enclose it.
            constexpr std::size_t deepest = 16;
            require(section.size() != deepest,
                    place + ": the subsection '" + squeeze(rest) + "' lies within " +
                      std::to_string(deepest) + " others, and none is known so deep.");
            require(rest.find('/') == std::string::npos,
                    place + ": the subsection '" + squeeze(rest) +
                      "' has a '/' in its name, as overrides have it; in a scene write "
                      "one subsection within the other.");
            section.push_back(squeeze(rest));
            opened_at.push_back(place);
            entries.push_back({join(section, "/"), "", "", place, folder});
          }
        else if (word == "set" && equals != std::string::npos && equals > 0)
          {
            entries.push_back({join(section, "/"),
                               squeeze(rest.substr(0, equals)),
                               trim(rest.substr(equals + 1)),
                               place,
                               folder});
            const std::string setting = entries.back().path();
            const auto [earlier, is_first] =
              lines_of_settings.emplace(setting, line.number);
            require(is_first,
                    place + ": '" + setting + "' was set before in line " +
                      std::to_string(earlier->second) + "; remove one of them.");
          }
        else if (word == "end" && rest.empty())
          {
            require(!section.empty(), place + ": this 'end' closes no subsection.");
            section.pop_back();
            opened_at.pop_back();
          }
        else
          throw InputError(place + ": cannot read '" + line.text +
                           "'; expected 'subsection NAME', 'set NAME = VALUE' or 'end'.");
      }
    if (!section.empty())
      throw InputError(opened_at.back() + ": the subsection '" + section.back() +
                       "' is not closed; add an 'end'.");
    return entries;
  }

  SceneEntry
  lex_override(const std::string &text, const std::string &folder)
  {
    const std::string        place  = "--set \"" + text + "\"";
    const auto               equals = text.find('=');
    std::vector<std::string> names  = split(text.substr(0, equals), '/');
    for (std::string &part : names)
      part = squeeze(part);
    const std::string name = names.back();
    names.pop_back();
    require(equals != std::string::npos && !name.empty() && !names.empty() &&
              !names.front().empty(),
            place + ": expected \"Section/Parameter=value\".");
    return {join(names, "/"), name, trim(text.substr(equals + 1)), place, folder};
  }
} // namespace strait
