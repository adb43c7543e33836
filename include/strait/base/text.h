// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace strait
{
  /** @p text without white space at both ends. */
  std::string trim(const std::string &text);

  /** @p text without the mark of its encoding that some editors begin it with. */
  std::string without_mark(const std::string &text);

  /** The parts of @p text between the characters @p separator, trimmed. */
  std::vector<std::string> split(const std::string &text, char separator);

  /** The parts, with @p separator between them. */
  std::string join(const std::vector<std::string> &parts, const std::string &separator);

  /** The row of @p table that has this name; null if there is none. */
  template <typename Table>
  auto
  find_row(const Table &table, const std::string &name)
  {
    const auto is_named = [&name](const auto &row) { return row.name == name; };
    const auto row      = std::find_if(std::begin(table), std::end(table), is_named);
    return row == std::end(table) ? nullptr : &*row;
  }

  /** The names of all rows of @p table, for messages and documentation. */
  template <typename Table>
  std::string
  names_in(const Table &table)
  {
    std::vector<std::string> names;
    for (const auto &row : table)
      names.emplace_back(row.name);
    return join(names, ", ");
  }

  /** A text in the manner of printf. */
  [[gnu::format(printf, 1, 2)]] std::string format(const char *pattern, ...);

  /** The shortest decimal number that reads back as @p value. */
  std::string to_text(double value);

  /** The candidate that a user who wrote @p word most likely meant: the nearest in edit
   *  distance, whatever the case, provided it is nearer than half its length. Empty if
   *  none is. */
  std::string nearest_name(const std::string              &word,
                           const std::vector<std::string> &candidates);

  /** "; did you mean 'NAME'?", or @p otherwise if @p name is empty. */
  std::string suggestion(const std::string &name, const std::string &otherwise = "");
} // namespace strait
