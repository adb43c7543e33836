// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/readers/height_map.h>

#include <charconv>
#include <fstream>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr char white_space[] = " \t\r";

    /**
     * Read the number at @p position, and move that behind it; nothing if there is none.
     * Unlike std::stod this does not depend on the locale: the decimal sign is a point.
     */
    std::optional<double>
    take_number(const char *&position, const char *const end)
    {
      // std::from_chars accepts a minus sign but no plus sign.
      const bool has_plus =
        end - position > 1 && position[0] == '+' && position[1] != '-';
      double     value  = 0;
      const auto result = std::from_chars(position + (has_plus ? 1 : 0), end, value);
      if (result.ec != std::errc())
        return {};
      position = result.ptr;
      return value;
    }

    /** What the lines above the numbers state: each value as written, by its key. */
    using Header = std::map<std::string, std::string>;

    /** The length of a side, as a number and its unit. */
    std::pair<double, LengthUnit>
    parse_side(const std::string &text, const std::string &file)
    {
      const char       *position = text.data();
      const char *const end      = position + text.size();
      const auto        value    = take_number(position, end);
      const LengthUnit  unit     = parse_length_unit(
        trim(std::string(position, static_cast<std::size_t>(end - position))));
      if (!value || !(*value > 0) || (!unit.name.empty() && !unit.metres))
        reject_for_import(file,
                          "states the side '" + text +
                            "' in its header, which is no positive length");
      return {*value, unit};
    }

    void
    read_header_line(Header &stated, const std::string &line, const std::string &file)
    {
      const std::size_t colon = line.find(':');
      if (colon == std::string::npos)
        {
          // It may be a mark of missing points or a scale.
          if (line.find_first_of("=0123456789") != std::string::npos)
            reject_for_import(file, "has the header line '" + trim(line) + "'");
          return;
        }
      const std::string  key     = trim(line.substr(1, colon - 1));
      const std::string  value   = trim(line.substr(colon + 1));
      const std::string &earlier = stated.emplace(key, value).first->second;
      if (earlier != value)
        reject_height_map(file,
                          "states '" + key + "' in its header as '" + earlier +
                            "' and as '" + value + "': remove one of these lines.");
      if (key != "Width" && key != "Height" && key != "Value units" && key != "Channel")
        reject_for_import(file, "has the header line '" + trim(line) + "'");
    }

    /** Append the numbers of a line. @return how many there are. */
    std::size_t
    append_row(std::vector<double> &values,
               const std::string   &line,
               const long           line_number,
               const std::string   &file)
    {
      const std::size_t n_before = values.size();
      for (std::size_t at = line.find_first_not_of(white_space); at != std::string::npos;)
        {
          const std::size_t end =
            std::min(line.find_first_of(white_space, at), line.size());
          const char *position = line.data() + at;
          const auto  value    = take_number(position, line.data() + end);
          if (!value || position != line.data() + end)
            reject_for_import(file,
                              "has '" +
                                line.substr(at, std::min<std::size_t>(end - at, 40)) +
                                "' in line " + std::to_string(line_number) +
                                ", which is no number");
          values.push_back(*value);
          at = line.find_first_not_of(white_space, end);
        }
      return values.size() - n_before;
    }
  } // namespace

  HeightMap
  read_matrix_text(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    Header        stated;
    HeightMap     map;
    std::string   line;
    bool          has_ended = false; // by a blank line, after which no other row may come
    for (long number = 1; std::getline(stream, line); ++number)
      {
        if (number == 1)
          line = without_byte_order_mark(line);
        const std::size_t first = line.find_first_not_of(white_space);
        if (first == std::string::npos)
          has_ended = map.ny > 0;
        else if (map.ny == 0 && line[first] == '#')
          read_header_line(stated, line.substr(first), file);
        else
          {
            if (has_ended)
              reject_for_import(file, "goes on behind a blank line");
            const std::size_t n = append_row(map.values, line, number, file);
            if (map.ny > 0 && n != static_cast<std::size_t>(map.nx))
              reject_height_map(file,
                                "has " + std::to_string(n) + " values in line " +
                                  std::to_string(number) + " and " +
                                  std::to_string(map.nx) +
                                  " in the rows above: mend or export it again.");
            map.nx = static_cast<int>(n);
            ++map.ny;
          }
      }
    if (stream.bad())
      reject_height_map(file, "cannot be read to its end: copy it again.");
    if (map.ny == 0)
      reject_height_map(file, "holds no numbers: check Surface/File.");
    if (stated.count("Width") == 0 || stated.count("Height") == 0)
      reject_for_import(
        file,
        "does not state its size as lines '# Width: 10 um' and '# Height: "
        "10 um' would");
    const auto [width, unit]        = parse_side(stated["Width"], file);
    const auto [height, other_unit] = parse_side(stated["Height"], file);
    if (unit.name.empty() != other_unit.name.empty())
      reject_for_import(file, "states a unit for one of its sides only");
    // The sides may have different units; both are expressed in that of the first.
    const double ratio = unit.name.empty() ? 1. : *other_unit.metres / *unit.metres;
    map.size           = {{width, height * ratio}};
    map.lateral_unit   = unit;
    map.height_unit    = parse_length_unit(stated["Value units"]);
    map.format         = "matrix text";
    return map;
  }
} // namespace strait
