// SPDX-License-Identifier: GPL-2.0-or-later
// Parameters as a scene file, and as a page of the manual.
#include <strait/base/parameter_table.h>

#include <algorithm>
#include <regex>
#include <sstream>

namespace strait
{
  namespace
  {
    std::string
    indent(const std::vector<std::string> &open)
    {
      return std::string(2 * open.size(), ' ');
    }

    /** Close the @p open subsections that do not enclose @p section, open the others. */
    void
    go_to(const std::vector<std::string> &section,
          std::vector<std::string>       &open,
          std::ostream                   &out)
    {
      while (open.size() > section.size() ||
             !std::equal(open.begin(), open.end(), section.begin()))
        {
          open.pop_back();
          out << indent(open) << "end\n";
        }
      while (open.size() < section.size())
        {
          out << indent(open) << "subsection " << section[open.size()] << "\n";
          open.push_back(section[open.size()]);
        }
    }

    /** Print @p text as lines of a comment in a scene file. */
    void
    print_comment(const std::string &text, const std::string &indent, std::ostream &out)
    {
      constexpr std::size_t width = 90;
      std::istringstream    words(text);
      std::string           line = indent + "#";
      for (std::string word; words >> word; line += " " + word)
        if (line.size() + word.size() >= width)
          {
            out << line << "\n";
            line = indent + "#";
          }
      out << line << "\n";
    }

    /** The meaning of @p parameter, preceded by its conditions on its own section, but
     *  for Enabled and for alternatives. */
    std::string
    meaning_of(const Parameter &parameter)
    {
      const std::string        own = parameter.section + "/";
      std::vector<std::string> conditions;
      for (const std::string &condition : parameter.conditions)
        if (condition.find('|') == std::string::npos && condition.rfind(own, 0) == 0 &&
            condition != own + "Enabled = true")
          conditions.push_back(condition.substr(own.size()));
      return join(conditions, " and ") + (conditions.empty() ? "" : ": ") +
             parameter.meaning;
    }

    /** @p text with the characters escaped that Markdown would interpret. */
    std::string
    escaped(const std::string &text)
    {
      return std::regex_replace(text, std::regex("[|*_]"), "\\$&");
    }
  } // namespace

  std::string
  ParameterTable::scene(const bool explained) const
  {
    std::ostringstream       out;
    std::vector<std::string> open;
    for (const Parameter &parameter : parameters)
      {
        go_to(split(parameter.section, '/'), open, out);
        if (explained)
          print_comment(meaning_of(parameter) + " Values: " + parameter.allowed + ".",
                        indent(open),
                        out);
        out << indent(open) << trim("set " + parameter.name + " = " + parameter.value)
            << "\n";
      }
    go_to({}, open, out);
    return out.str();
  }

  std::string
  ParameterTable::markdown() const
  {
    std::ostringstream out;
    out
      << "# Parameters\n\n"
      << "All parameters of a scene, section by section, as `strait --parameters md` "
         "prints them;\n`strait --parameters prm` prints a scene with every default. The "
         "unit stands in brackets,\n[1] for a number without one. Numbers are 0 or of a "
         "magnitude from 1e-30 to 1e30.\nWhat begins with a condition, as `Kind = file:` "
         "does, counts where that holds, and the parameters\nof an effect where it is "
         "`Enabled`; where they are given all the same, a warning says so.\n\n";
    std::string section;
    for (const Parameter &parameter : parameters)
      {
        if (parameter.section != section)
          out << (section.empty() ? "" : "\n") << "## "
              << join(split(parameter.section, '/'), " / ") << "\n\n"
              << "| Parameter | Default | Values | Meaning |\n|-|-|-|-|\n";
        section = parameter.section;
        out << "| " << parameter.name << " | "
            << (parameter.value.empty() ? "" : "`" + parameter.value + "`") << " | "
            << parameter.allowed << " | " << escaped(meaning_of(parameter)) << " |\n";
      }
    return out.str() + "\n";
  }
} // namespace strait
