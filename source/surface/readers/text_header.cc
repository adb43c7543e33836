// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/readers/text_header.h>

#include <algorithm>
#include <charconv>
#include <regex>
#include <utility>

namespace strait
{
  namespace
  {
    /** A header line in pieces. */
    struct Statement
    {
      std::string key; // lower case
      std::string value;
      std::string unit;
    };

    /** "KEY: VALUE UNIT" with : or = or, between quotes, commas and semicolons. */
    std::optional<Statement>
    take_apart(const std::string &line)
    {
      std::string plain = line;
      plain.erase(std::remove(plain.begin(), plain.end(), '"'), plain.end());
      static const std::regex colon("^[#%\\s]*([^:=,;\\t]+?)\\s*[:=]\\s*(.*?)\\s*$");
      static const std::regex cells(
        "^[#%\\s]*([^:=,;\\t]+?)\\s*[,;\\t]\\s*(.*?)[,;\\t\\s]*$");
      // The value of a line with commas may be a number with a unit in the next cell.
      static const std::regex value_and_unit("^([-+.,\\deE]+)[\\s,;]+(\\S.*)$");

      std::smatch match;
      if (!std::regex_match(plain, match, colon) &&
          !std::regex_match(plain, match, cells))
        return {};
      Statement result{match[1], match[2], ""};
      std::transform(result.key.begin(), result.key.end(), result.key.begin(), ::tolower);
      std::smatch       parts;
      const std::string whole = result.value;
      if (std::regex_match(whole, parts, value_and_unit))
        {
          result.value = parts[1];
          result.unit  = trim(parts[2]);
        }
      return result;
    }

    bool
    is_one_of(const std::string &key, std::initializer_list<const char *> names)
    {
      return std::any_of(names.begin(), names.end(), [&key](const char *name) {
        return key == name;
      });
    }

    std::optional<double>
    whole_number_text(std::string text)
    {
      std::replace(text.begin(), text.end(), ',', '.');
      const char       *position = text.data();
      const char *const end      = position + text.size();
      const auto        value    = read_number(position, end);
      return position == end ? value : std::nullopt;
    }

    /** A number of rows or columns; 0, which no map has, for what cannot be one. */
    int
    count(const std::string &text)
    {
      const double value = whole_number_text(text).value_or(0.);
      return value >= 0 && value < 1e9 ? static_cast<int>(value) : 0;
    }
  } // namespace

  TextHeader::TextHeader(std::string file_name)
    : file(std::move(file_name))
  {
  }

  TextHeader::Length
  TextHeader::parse_length(const std::string &number, const std::string &unit) const
  {
    const auto value = whole_number_text(number);
    if (!value || !(*value > 0) || *value > 1e300)
      reject_height_map(file,
                        "states the length '" + number + unit +
                          "' in its header, which must be a positive number.");
    if (unit.empty())
      return {*value, false};
    const auto metres = metres_in(unit);
    if (!metres)
      reject_height_map(file,
                        "states a length in the unit '" + unit +
                          "' in its header, and known are " + length_units +
                          ": change the header.");
    return {*value * *metres, true};
  }

  bool
  TextHeader::parse_lateral(const std::string &key,
                            const std::string &number,
                            const std::string &unit)
  {
    // An image of so many pixels, not a length.
    if (is_one_of(unit, {"px", "pixel", "pixels", "Pixel"}))
      return false;
    if (is_one_of(key, {"width", "x size", "x-size", "x-length", "x length"}))
      sides[0] = parse_length(number, unit);
    else if (is_one_of(key, {"height", "y size", "y-size", "y-length", "y length"}))
      sides[1] = parse_length(number, unit);
    else if (is_one_of(key, {"pixel size", "xy calibration", "pixel pitch", "spacing"}))
      spacings[0] = spacings[1] = parse_length(number, unit);
    else if (is_one_of(key, {"x pixel size", "x spacing", "dx"}))
      spacings[0] = parse_length(number, unit);
    else if (is_one_of(key, {"y pixel size", "y spacing", "dy"}))
      spacings[1] = parse_length(number, unit);
    else
      return false;
    return true;
  }

  void
  TextHeader::parse_line(const std::string &line)
  {
    static const std::regex extents("^[#\\s]*h=(\\d{1,9})\\s+w=(\\d{1,9})\\s*$",
                                    std::regex::icase);
    static const std::regex factor(
      "^[#\\s]*height conversion factor "
      "\\(-> (\\S+)\\)\\s*=\\s*(\\S+)\\s*$",
      std::regex::icase);
    std::smatch match;
    if (std::regex_match(line, match, extents))
      {
        n_rows    = std::stoi(match[1]);
        n_columns = std::stoi(match[2]);
        return;
      }
    if (std::regex_match(line, match, factor))
      {
        const Length one = parse_length(match[2], match[1]);
        value_unit       = {match[2].str() + " " + match[1].str(), one.value};
        has_factor       = true;
        return;
      }
    const auto statement = take_apart(line);
    if (!statement)
      return;
    const auto &[key, value, unit] = *statement;
    if (is_one_of(key,
                  {"value units",
                   "value unit",
                   "height unit",
                   "height units",
                   "z unit",
                   "z units",
                   "z-unit",
                   "data unit",
                   "unit"}))
      {
        if (!has_factor && !value.empty())
          value_unit = parse_length_unit(unit.empty() ? value : value + " " + unit);
      }
    else if (is_one_of(key, {"xy unit", "xy units", "x unit", "lateral unit"}))
      coordinate_unit = parse_length_unit(value);
    else if (is_one_of(key, {"x-pixels", "x pixels", "columns"}))
      n_columns = count(value);
    else if (is_one_of(key, {"y-pixels", "y pixels", "rows"}))
      n_rows = count(value);
    else if (key == "bit2nm")
      {
        value_unit = {value + " nm", parse_length(value, "nm").value};
        has_factor = true;
      }
    else
      parse_lateral(key, value, unit);
  }

  void
  TextHeader::complete(HeightMap &map) const
  {
    map.height_unit               = value_unit;
    const auto              &used = sides[0] && sides[1] ? sides : spacings;
    const std::array<int, 2> n    = {{map.nx, map.ny}};
    if (!used[0] || !used[1])
      return;
    if (used[0]->has_unit != used[1]->has_unit)
      reject_height_map(file,
                        "states a unit for one of its sides only: complete its header.");
    std::array<double, 2> size;
    for (int d = 0; d < 2; ++d)
      size[d] = used[d]->value * (&used == &sides ? 1 : n[d]);
    map.size = size;
    if (used[0]->has_unit)
      map.lateral_unit = {"m", 1.};
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
