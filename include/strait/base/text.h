// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_text_h
#define strait_base_text_h

#include <string>
#include <vector>

namespace strait
{
  /** @p text without white space at both ends. */
  std::string trim(const std::string &text);

  /** The parts of @p text between the characters @p separator, trimmed. */
  std::vector<std::string> split(const std::string &text, char separator);

  /** The parts, with @p separator between them. */
  std::string join(const std::vector<std::string> &parts, const std::string &separator);

  /** A text in the manner of printf. */
  [[gnu::format(printf, 1, 2)]] std::string format(const char *pattern, ...);

  /** The shortest decimal number that reads back as @p value. */
  std::string to_text(double value);

  /**
   * How many characters must be inserted, removed, replaced or swapped with
   * their neighbour to turn @p from into @p to; case does not count.
   */
  int edit_distance(const std::string &from, const std::string &to);

  /**
   * The candidate that a user who wrote @p word most likely meant: the nearest
   * in edit distance, provided it is nearer than half its length. Empty if none
   * is.
   */
  std::string nearest_name(const std::string              &word,
                           const std::vector<std::string> &candidates);

  /** "; did you mean 'NAME'?", or @p otherwise if @p name is empty. */
  std::string suggestion(const std::string &name, const std::string &otherwise = "");
} // namespace strait

#endif
