// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/formats.h>
#include <strait/surface/readers/text_header.h>
#include <strait/surface/readers/text_row.h>

#include <algorithm>
#include <fstream>

namespace strait
{
  namespace
  {
    /** No header line is longer, and a regular expression must not see more. */
    constexpr std::size_t longest_header_line = 1000;

    constexpr char byte_order_mark[] = "\xef\xbb\xbf";

    /** Blank, or a comment. */
    bool
    is_skipped(const std::string &line)
    {
      return line.empty() || line[0] == '#' ||
             line.find_first_not_of(" \t\r") == std::string::npos;
    }

    /** Add a row; the first one sets how many values each must have. */
    void
    append_row(TextRow           &row,
               HeightMap         &map,
               const std::string &line,
               const long         line_number,
               const std::string &file)
    {
      const std::size_t n_before = map.values.size();
      row.append(line, line_number, map.values);
      const std::size_t n_values = map.values.size() - n_before;
      if (map.ny == 0)
        map.nx = static_cast<int>(n_values);
      else if (n_values != static_cast<std::size_t>(map.nx))
        reject_height_map(file,
                          "has " + std::to_string(n_values) + " values in line " +
                            std::to_string(line_number) + " and " +
                            std::to_string(map.nx) +
                            " in the rows above: mend or export it again.");
      ++map.ny;
    }

    void
    check_extents(const HeightMap &map, const TextHeader &header, const std::string &file)
    {
      if (map.ny == 0)
        reject_height_map(file, "holds no numbers: check Surface/File.");
      const int n_rows    = header.n_rows.value_or(map.ny);
      const int n_columns = header.n_columns.value_or(map.nx);
      if (n_rows != map.ny || n_columns != map.nx)
        reject_height_map(file,
                          "promises " + std::to_string(n_rows) + " rows of " +
                            std::to_string(n_columns) + " values and holds " +
                            std::to_string(map.ny) + " rows of " +
                            std::to_string(map.nx) + ": copy or export it again.");
    }
  } // namespace

  HeightMap
  read_matrix_text(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    TextHeader    header(file);
    TextRow       row(file);
    HeightMap     map;
    std::string   line;
    for (long line_number = 1; std::getline(stream, line); ++line_number)
      {
        if (line_number == 1 && line.compare(0, 3, byte_order_mark) == 0)
          line.erase(0, 3);
        if (map.ny > 0 ? !is_skipped(line) : row.is_data(line))
          append_row(row, map, line, line_number, file);
        else if (map.ny == 0 && line.size() <= longest_header_line)
          header.parse_line(line);
      }
    if (stream.bad())
      reject_height_map(file, "cannot be read to its end: copy it again.");
    check_extents(map, header, file);
    header.complete(map);
    return map;
  }
} // namespace strait
