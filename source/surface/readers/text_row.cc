// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>
#include <strait/surface/readers/text_header.h>
#include <strait/surface/readers/text_row.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    bool
    is_space(const char c)
    {
      return c == ' ' || c == '\t' || c == '\r';
    }

    bool
    marks_missing_point(std::string token)
    {
      std::transform(token.begin(), token.end(), token.begin(), ::tolower);
      for (const char *marker :
           {"bad", "***", "**", "--", "---", "#n/a", "n/a", "na", "nodata", "masked"})
        if (token == marker)
          return true;
      return false;
    }

    /** The words of @p line, whatever separates them. */
    std::vector<std::string>
    loose_words(const std::string &line)
    {
      std::vector<std::string> words;
      std::string              word;
      for (const char c : line + " ")
        if (is_space(c) || c == ';' || c == ',')
          {
            if (!word.empty())
              words.push_back(word);
            word.clear();
          }
        else
          word += c;
      return words;
    }

    bool
    is_number(const std::string &word)
    {
      const char       *position = word.data();
      const char *const end      = position + word.size();
      return read_number(position, end) && position == end;
    }
  } // namespace

  TextRow::TextRow(std::string file_name)
    : file(std::move(file_name))
  {
  }

  bool
  TextRow::is_data(const std::string &line) const
  {
    const std::vector<std::string> words = loose_words(line.substr(0, 1000));
    if (words.empty())
      return false;
    if (is_number(words[0]))
      return true;
    // A row may begin with a missing point, but "---" alone is an ornament.
    return words.size() > 1 && marks_missing_point(words[0]) &&
           (is_number(words[1]) || marks_missing_point(words[1]));
  }

  void
  TextRow::settle_separator(const std::string &line)
  {
    if (line.find(';') != std::string::npos)
      {
        separator = ';';
        return;
      }
    // White space separates unless a comma stands beside it.
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      if (is_space(line[i]) && !is_space(line[i - 1]))
        {
          const auto next =
            std::find_if_not(line.begin() + static_cast<long>(i), line.end(), is_space);
          if (next != line.end() && line[i - 1] != ',' && *next != ',')
            {
              separator = ' ';
              return;
            }
        }
    if (line.find(',') != std::string::npos)
      separator = ',';
  }

  double
  TextRow::parse(const char       *begin,
                 const char       *end,
                 const long        line_number,
                 const std::size_t column)
  {
    const auto place = [&]() {
      return " in line " + std::to_string(line_number) + ", column " +
             std::to_string(column) + " (counted from 0)";
    };
    const char *position = begin;
    auto        value    = read_number(position, end);
    char        sign     = std::find(begin, end, '.') == end ? char(0) : '.';
    std::string with_point;
    if (position != end && separator != ',' && std::count(begin, end, ',') == 1)
      {
        with_point.assign(begin, end);
        std::replace(with_point.begin(), with_point.end(), ',', '.');
        position             = with_point.data();
        const char *copy_end = position + with_point.size();
        value                = read_number(position, copy_end);
        sign                 = ',';
        position             = position == copy_end ? end : begin;
      }
    if (!value || position != end)
      {
        if (marks_missing_point(std::string(begin, end)))
          return std::numeric_limits<double>::quiet_NaN();
        reject_height_map(file,
                          "has something that is not a number" + place() +
                            ": mend or export it again.");
      }
    if (sign != 0 && decimal_sign != 0 && sign != decimal_sign)
      reject_height_map(file,
                        "mixes decimal points and commas" + place() +
                          ": mend or export it again.");
    if (sign != 0)
      decimal_sign = sign;
    return *value;
  }

  void
  TextRow::append(const std::string   &line,
                  const long           line_number,
                  std::vector<double> &values)
  {
    if (separator == 0)
      settle_separator(line);
    const std::size_t n_before = values.size();
    const char       *position = line.data();
    const char       *line_end = position + line.size();
    while (line_end != position && is_space(line_end[-1]))
      --line_end;
    const auto is_end_of_number = [this](const char c) {
      return separator == ' ' || separator == 0 ? is_space(c) : c == separator;
    };
    position = std::find_if_not(position, line_end, is_space);
    while (position != line_end)
      {
        const char *next  = std::find_if(position, line_end, is_end_of_number);
        const char *close = next;
        while (close != position && is_space(close[-1]))
          --close;
        values.push_back(parse(position, close, line_number, values.size() - n_before));
        // A separator may also end a line.
        position = next == line_end ? line_end : next + 1;
        position = std::find_if_not(position, line_end, is_space);
      }
  }
} // namespace strait
