// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/matrix_text.h>
#include <strait/surface/readers/text_header.h>

#include <algorithm>
#include <fstream>
#include <utility>

namespace strait
{
  namespace
  {
    /** No header line is longer, and a regular expression must not see more. */
    constexpr std::size_t longest_header_line = 1000;

    constexpr char byte_order_mark[] = "\xef\xbb\xbf";

    bool
    is_space(const char c)
    {
      return c == ' ' || c == '\t' || c == '\r';
    }

    bool
    is_separator(const char c)
    {
      return c == ',' || c == ';';
    }

    const char *
    skip_space(const char *position, const char *end)
    {
      return std::find_if_not(position, end, is_space);
    }

    /** Whether the first word of @p line is a number from end to end. */
    bool
    starts_with_number(const std::string &line)
    {
      const char *const end      = line.data() + line.size();
      const char       *position = skip_space(line.data(), end);
      return read_number(position, end) &&
             (position == end || is_space(*position) || is_separator(*position));
    }

    /** The rows of a file, read one line after the other. */
    class Rows
    {
    public:
      explicit Rows(const std::string &file_name)
        : file(file_name)
      {
      }

      /** Append the values of a line; the first one sets how many a row has. */
      void append(const std::string &line, long line_number);

      HeightMap map;

    private:
      /** Step over what separates two values, which must be the same always. */
      const char *
      skip_separator(const char *position, const char *end, const std::string &where);

      const std::string &file;
      char               separator = 0; // none seen yet
    };

    void
    Rows::append(const std::string &line, const long line_number)
    {
      const std::string where    = "in line " + std::to_string(line_number);
      const auto        n_before = map.values.size();
      const char *const end      = line.data() + line.size();
      const char       *position = skip_space(line.data(), end);
      while (position != end)
        {
          const auto value = read_number(position, end);
          if (!value)
            reject_height_map(file,
                              "has something that is not a number " + where +
                                ", column " +
                                std::to_string(map.values.size() - n_before) +
                                " (counted from 0): mend or export it again.");
          map.values.push_back(*value);
          position = skip_separator(position, end, where);
        }
      const auto n_values = map.values.size() - n_before;
      if (map.ny == 0)
        map.nx = static_cast<int>(n_values);
      else if (n_values != static_cast<std::size_t>(map.nx))
        reject_height_map(file,
                          "has " + std::to_string(n_values) + " values " + where +
                            " and " + std::to_string(map.nx) +
                            " in the rows above: mend or export it again.");
      ++map.ny;
    }

    const char *
    Rows::skip_separator(const char *position, const char *end, const std::string &where)
    {
      const char *const after_value = position;
      position                      = skip_space(position, end);
      if (position == end)
        return end;
      char seen = ' ';
      if (is_separator(*position))
        {
          seen     = *position;
          position = skip_space(position + 1, end);
        }
      else if (position == after_value)
        reject_height_map(file,
                          "has something that is not a number " + where +
                            ": mend or export it again.");
      if (position == end) // a separator may also end a line
        return end;
      if (separator != 0 && separator != seen)
        reject_height_map(file,
                          "mixes separators " + where +
                            ": separate the values by one of white space, commas and "
                            "semicolons, and write decimals with a point.");
      separator = seen;
      return position;
    }

    void
    check_extents(const HeightMap &map, const TextHeader &header, const std::string &file)
    {
      if (map.ny == 0)
        reject_height_map(file, "holds no numbers: check Surface/File.");
      if (header.n_rows.value_or(map.ny) != map.ny ||
          header.n_columns.value_or(map.nx) != map.nx)
        reject_height_map(file,
                          "promises " + std::to_string(*header.n_rows) + " rows of " +
                            std::to_string(*header.n_columns) + " values and holds " +
                            std::to_string(map.ny) + " rows of " +
                            std::to_string(map.nx) + ": copy or export it again.");
    }
  } // namespace

  HeightMap
  read_matrix_text(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    TextHeader    header;
    Rows          rows(file);
    std::string   line;
    for (long line_number = 1; std::getline(stream, line); ++line_number)
      {
        if (line_number == 1 && line.compare(0, 3, byte_order_mark) == 0)
          line.erase(0, 3);
        const bool skipped =
          line[0] == '#' || std::all_of(line.begin(), line.end(), is_space);
        if (starts_with_number(line) || (rows.map.ny > 0 && !skipped))
          rows.append(line, line_number);
        else if (rows.map.ny == 0 && line.size() <= longest_header_line)
          header.parse_line(line, file);
      }
    if (stream.bad())
      reject_height_map(file, "cannot be read to its end: copy it again.");

    HeightMap map = std::move(rows.map);
    check_extents(map, header, file);
    map.size = header.size(map.nx, map.ny);
    for (double &value : map.values)
      value *= header.value_unit;
    return map;
  }
} // namespace strait
