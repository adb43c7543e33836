// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_choices_h
#define strait_base_choices_h

#include <string>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * The names by which a scene chooses a value of an enumeration: one table
   * serves the pattern, the default and the parser.
   */
  template <typename Enumeration>
  class Choices
  {
  public:
    Choices(std::initializer_list<std::pair<Enumeration, const char *>> table)
      : table(table)
    {
    }

    /** "name|name|...", as Patterns::Selection wants it. */
    std::string
    pattern() const
    {
      std::string names;
      for (const auto &row : table)
        names += (names.empty() ? "" : "|") + std::string(row.second);
      return names;
    }

    /** The name of @p value in the scene, empty if the table lacks it. */
    std::string
    name(const Enumeration value) const
    {
      for (const auto &row : table)
        if (row.first == value)
          return row.second;
      return {};
    }

    /** The value called @p name, which must be in the table. */
    Enumeration
    value(const std::string &name) const
    {
      for (const auto &row : table)
        if (row.second == name)
          return row.first;
      return table.front().first;
    }

  private:
    std::vector<std::pair<Enumeration, const char *>> table;
  };
} // namespace strait

#endif
