// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>
#include <strait/surface/readers/text_header.h>

#include <charconv>
#include <map>
#include <regex>

namespace strait
{
  namespace
  {
    double
    in_metres(const std::string &unit, const std::string &file)
    {
      static const std::map<std::string, double> units = {
        {"m", 1.},
        {"cm", 1e-2},
        {"mm", 1e-3},
        {"um", 1e-6},
        {"\xc2\xb5m", 1e-6}, // micro sign, UTF-8
        {"\xce\xbcm", 1e-6}, // Greek mu, UTF-8
        {"\xb5m", 1e-6},     // micro sign, Latin-1
        {"nm", 1e-9},
        {"pm", 1e-12}};
      const auto found = units.find(unit);
      if (found == units.end())
        reject_height_map(file,
                          "states a length in the unit '" + unit +
                            "' in its header: use m, cm, mm, um, nm or pm.");
      return found->second;
    }

    double
    parse_length(const std::string &number,
                 const std::string &unit,
                 const std::string &file)
    {
      const char       *position = number.data();
      const char *const end      = position + number.size();
      const auto        value    = read_number(position, end);
      if (!value || position != end || !(*value > 0) || *value > 1e300)
        reject_height_map(file,
                          "states the length '" + number + unit +
                            "' in its header, which must be a positive number.");
      return *value * in_metres(unit, file);
    }

    /** "KEY: NUMBER UNIT", "KEY=NUMBER UNIT", with or without # before it. */
    std::regex
    length_pattern(const std::string &key)
    {
      return std::regex("^[#\\s]*" + key + "\\s*[:=]\\s*([-+.\\deE]*)\\s*(\\S*)\\s*$",
                        std::regex::icase);
    }
  } // namespace

  void
  TextHeader::parse_line(const std::string &line, const std::string &file)
  {
    static const std::regex extents("^[#\\s]*h=(\\d{1,9})\\s+w=(\\d{1,9})\\s*$",
                                    std::regex::icase);
    static const std::regex factor(
      "^[#\\s]*height conversion factor \\(-> (\\S+)\\)\\s*=\\s*(\\S+)\\s*$",
      std::regex::icase);
    static const std::regex unit_of_values("^[#\\s]*value units\\s*:\\s*(\\S+)\\s*$",
                                           std::regex::icase);
    static const std::regex pixel   = length_pattern("pixel size");
    static const std::regex along_x = length_pattern("width");
    static const std::regex along_y = length_pattern("height");

    std::smatch match;
    if (std::regex_match(line, match, extents))
      {
        n_rows    = std::stoi(match[1]);
        n_columns = std::stoi(match[2]);
      }
    else if (std::regex_match(line, match, factor))
      value_unit = parse_length(match[2], match[1], file);
    else if (std::regex_match(line, match, unit_of_values))
      value_unit = in_metres(match[1], file);
    else if (std::regex_match(line, match, pixel))
      pixel_size = parse_length(match[1], match[2], file);
    else if (std::regex_match(line, match, along_x))
      width = parse_length(match[1], match[2], file);
    else if (std::regex_match(line, match, along_y))
      height = parse_length(match[1], match[2], file);
  }

  std::optional<std::array<double, 2>>
  TextHeader::size(const int nx, const int ny) const
  {
    if (width && height)
      return {{*width, *height}};
    if (pixel_size)
      return {{*pixel_size * nx, *pixel_size * ny}};
    return {};
  }

  std::optional<double>
  read_number(const char *&position, const char *end)
  {
    // std::from_chars takes a minus sign but no plus sign.
    const char *begin = position;
    if (end - begin > 1 && begin[0] == '+' && begin[1] != '-')
      ++begin;
    double     value  = 0;
    const auto result = std::from_chars(begin, end, value);
    if (result.ec != std::errc())
      return {};
    position = result.ptr;
    return value;
  }
} // namespace strait
