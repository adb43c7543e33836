// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <charconv>
#include <cstdarg>
#include <cstdio>

namespace strait
{
  namespace
  {
    /** The number of characters that must be inserted, removed, replaced or swapped with
     *  their neighbour to turn @p from into @p to; case is ignored. */
    int
    edit_distance(const std::string &from, const std::string &to)
    {
      const std::string a = boost::to_lower_copy(from), b = boost::to_lower_copy(to);
      // distance[i][j]: from the first i letters of a to the first j of b (optimal string
      // alignment).
      std::vector<std::vector<int>> distance(a.size() + 1,
                                             std::vector<int>(b.size() + 1));
      for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j)
          {
            int &least = distance[i][j];
            least      = static_cast<int>(i + j); // all removed and inserted
            if (i > 0 && j > 0)
              least = std::min({distance[i - 1][j] + 1,
                                distance[i][j - 1] + 1,
                                distance[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              least = std::min(least, distance[i - 2][j - 2] + 1);
          }
      return distance[a.size()][b.size()];
    }
  } // namespace

  std::string
  trim(const std::string &text)
  {
    return boost::trim_copy_if(text, boost::is_any_of(" \t\r\n"));
  }

  std::string
  without_byte_order_mark(const std::string &text)
  {
    const std::string mark = "\xef\xbb\xbf";
    return text.substr(text.compare(0, mark.size(), mark) == 0 ? mark.size() : 0);
  }

  std::vector<std::string>
  split(const std::string &text, const char separator)
  {
    std::vector<std::string> parts;
    boost::split(parts, text, [separator](const char c) { return c == separator; });
    for (std::string &part : parts)
      part = trim(part);
    return parts;
  }

  std::string
  join(const std::vector<std::string> &parts, const std::string &separator)
  {
    return boost::join(parts, separator);
  }

  std::string
  format(const char *pattern, ...)
  {
    std::va_list arguments, again;
    va_start(arguments, pattern);
    va_copy(again, arguments);
    std::string text(std::vsnprintf(nullptr, 0, pattern, arguments), ' ');
    std::vsnprintf(text.data(), text.size() + 1, pattern, again);
    va_end(again);
    va_end(arguments);
    return text;
  }

  std::string
  to_text(const double value)
  {
    char       buffer[64];
    const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
    return {buffer, result.ptr};
  }

  std::string
  nearest_name(const std::string &word, const std::vector<std::string> &candidates)
  {
    const auto is_nearer = [&word](const std::string &a, const std::string &b) {
      return edit_distance(word, a) < edit_distance(word, b);
    };
    const auto nearest =
      std::min_element(candidates.begin(), candidates.end(), is_nearer);
    // A smaller fraction of the length misses more misspellings; a larger one suggests
    // names that have nothing to do with the word.
    const bool is_near = nearest != candidates.end() &&
                         2 * edit_distance(word, *nearest) <
                           static_cast<int>(std::max(word.size(), nearest->size()));
    return is_near ? *nearest : "";
  }

  std::string
  suggestion(const std::string &name, const std::string &otherwise)
  {
    return name.empty() ? otherwise : "; did you mean '" + name + "'?";
  }
} // namespace strait
