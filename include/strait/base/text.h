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

  /** @p text without the byte order mark (UTF-8) that some editors put at its head. */
  std::string without_byte_order_mark(const std::string &text);

  /** The parts of @p text between the characters @p separator, trimmed. */
  std::vector<std::string> split(const std::string &text, char separator);

  /** The parts in one text, with @p separator between them. */
  std::string join(const std::vector<std::string> &parts, const std::string &separator);

  /** A pointer to the row of @p table that has this name; null if there is none. */
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

  /** Format a text as printf does. */
  [[gnu::format(printf, 1, 2)]] std::string format(const char *pattern, ...);

  /** The shortest decimal number that reads back as @p value. */
  std::string to_text(double value);

  /** The candidate that a user who wrote @p word most likely meant: the nearest in edit
   *  distance, whatever the case, provided that distance is less than half the length of
   *  the longer one of both. Empty if there is none. */
  std::string nearest_name(const std::string              &word,
                           const std::vector<std::string> &candidates);

  /** "; did you mean 'NAME'?", or @p otherwise if @p name is empty. */
  std::string suggestion(const std::string &name, const std::string &otherwise = "");
} // namespace strait
