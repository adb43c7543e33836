// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

namespace strait
{
  namespace
  {
    // What the NetCDF library fills in for values that were never written.
    constexpr double usual_fill = 9.969209968386869e36;

    constexpr auto big = boost::endian::order::big;

    double
    decode(const char *bytes, const std::uint64_t type)
    {
      return type == type_double  ? load<double, big>(bytes)
             : type == type_int   ? load<std::int32_t, big>(bytes)
             : type == type_short ? load<std::int16_t, big>(bytes)
             : type == type_byte  ? load<std::int8_t, big>(bytes)
                                  : load<float, big>(bytes);
    }

    bool
    is_number(const std::uint64_t type)
    {
      return type >= type_byte && type <= type_double && type != type_char;
    }

    std::uint64_t
    bytes_of(const std::uint64_t type)
    {
      constexpr std::uint64_t bytes[] = {1, 1, 1, 2, 4, 4, 8};
      return bytes[type <= type_double ? type : 0];
    }

    struct Attribute
    {
      std::string           text;
      std::optional<double> number; // if there is exactly one
    };

    struct Dimension
    {
      std::string   name;
      std::uint64_t n = 0;
    };

    struct Variable
    {
      std::vector<std::uint64_t>       dimensions; // by their numbers
      std::map<std::string, Attribute> attributes;
      std::uint64_t                    type  = 0;
      std::uint64_t                    begin = 0; // bytes from the start of the file

      /** The attribute @p name; an empty one if there is none. */
      const Attribute &
      operator[](const std::string &name) const
      {
        static const Attribute none;
        const auto             found = attributes.find(name);
        return found == attributes.end() ? none : found->second;
      }

      /** Whether the attribute @p name is 1 or a word for yes. */
      bool
      says(const std::string &name) const
      {
        const Attribute  &attribute = (*this)[name];
        const std::string word      = boost::to_lower_copy(attribute.text);
        return attribute.number == 1. || word == "true" || word == "yes" || word == "1";
      }

      /** The unit; empty if none is stated. Throws InputError about @p file if two units
       *  of different lengths are. */
      std::string
      unit(const std::string &file) const
      {
        std::string unit;
        for (const char *name : {"unit", "units", "length_unit"})
          if (const std::string &text = (*this)[name].text; unit.empty())
            unit = text;
          else if (!text.empty() &&
                   parse_length_unit(text).metres != parse_length_unit(unit).metres)
            reject_for_import(file,
                              "states two units, '" + unit + "' and '" + text + "'");
        return unit;
      }
    };

    /**
     * The header of a file: big-endian numbers, and texts padded to four bytes. It is
     * never read beyond the end of the file, whatever the counts in it claim.
     */
    class ClassicHeader
    {
    public:
      explicit ClassicHeader(const std::string &file_)
        : file(file_)
      {
        std::ifstream stream(file, std::ios::binary);
        // Headers of maps have some hundred bytes; this leaves room for any history.
        constexpr std::uint64_t longest = 1 << 20;
        content.resize(
          std::min<std::uint64_t>(longest, std::filesystem::file_size(file)));
        stream.read(content.data(), static_cast<std::streamsize>(content.size()));
        const std::string magic            = take(4);
        const int         n_bytes_of_begin = magic[3] == 1 ? 4 : 8;
        number(4); // records, of which a map has none
        for (std::uint64_t n = count(); n > 0; --n)
          {
            const std::string name = text();
            dimensions.push_back({name, number(4)});
          }
        attributes();
        for (std::uint64_t n = count(); n > 0; --n)
          {
            const std::string name     = text();
            Variable         &variable = variables[name];
            for (std::uint64_t d = number(4); d > 0; --d)
              variable.dimensions.push_back(number(4));
            variable.attributes = attributes();
            variable.type       = number(4);
            number(4); // its size, which follows from the rest
            variable.begin = number(n_bytes_of_begin);
          }
      }

      std::vector<Dimension>          dimensions;
      std::map<std::string, Variable> variables;

    private:
      std::string
      take(const std::uint64_t n_bytes)
      {
        if (n_bytes > content.size() - position)
          reject_height_map(file, "ends within its header: copy or import it again.");
        std::string bytes = content.substr(position, n_bytes);
        position += n_bytes;
        return bytes;
      }

      std::uint64_t
      number(const int n_bytes)
      {
        const std::string bytes = take(static_cast<std::uint64_t>(n_bytes));
        return n_bytes == 4 ? load<std::uint32_t, big>(bytes.data())
                            : load<std::uint64_t, big>(bytes.data());
      }

      std::string
      padded(const std::uint64_t n_bytes)
      {
        return take((n_bytes + 3) / 4 * 4).substr(0, n_bytes);
      }

      std::string
      text()
      {
        return padded(number(4));
      }

      /** The length of a list, which follows its tag. */
      std::uint64_t
      count()
      {
        number(4);
        return number(4);
      }

      std::map<std::string, Attribute>
      attributes()
      {
        std::map<std::string, Attribute> result;
        for (std::uint64_t n = count(); n > 0; --n)
          {
            const std::string   name = text();
            const std::uint64_t type = number(4), length = number(4);
            const std::string   bytes = padded(length * bytes_of(type));
            Attribute          &found = result[name];
            if (type == type_char)
              found.text = bytes.substr(0, bytes.find('\0'));
            else if (length == 1 && is_number(type))
              found.number = decode(bytes.data(), type);
          }
        return result;
      }

      std::string file;
      std::string content;
      std::size_t position = 0;
    };

    /** Refuse a variable with attributes that change the meaning of its numbers. */
    void
    require_plain(const std::string                        &file,
                  const Variable                           &variable,
                  const std::initializer_list<const char *> names)
    {
      for (const char *name : names)
        if (variable.attributes.count(name) > 0)
          reject_for_import(file, std::string("has the attribute ") + name);
    }

    /** The rise of the coordinates along the dimension @p along from the first to the
     *  last. Throws InputError unless their steps are equal to within a twentieth. */
    double
    rise_of(const std::string &file, const Variable &variable, const Dimension &along)
    {
      const auto decode_one = [&](const char *at) { return decode(at, variable.type); };
      const std::vector<double> x =
        read_values(
          file, {along.n, 1, false, variable.begin, bytes_of(variable.type), decode_one})
          .values;
      const double rise = x.back() - x.front();
      const double step = rise / static_cast<double>(along.n - 1);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!(std::abs(x[i] - x.front() - static_cast<double>(i) * step) <=
              std::abs(step) / 20.))
          reject_for_import(file,
                            "has coordinates '" + along.name + "' without equal steps");
      return rise;
    }

    /**
     * The side along the dimension @p name: the length that its n coordinates state, or n
     * of their steps if that is the span from the first to the last, or if they state a
     * unit but no length; nothing if they state neither. Throws InputError unless the
     * length is n − 1 to n steps, to within a hundredth of it and a tenth of a step.
     */
    std::optional<double>
    side_along(const std::string   &file,
               const ClassicHeader &header,
               const std::string   &name)
    {
      const auto found = header.variables.find(name);
      if (found == header.variables.end())
        return {};
      const Variable             &variable = found->second;
      const std::optional<double> stated   = variable["length"].number;
      if (variable.dimensions.size() != 1 ||
          variable.dimensions[0] >= header.dimensions.size())
        return stated;
      const Dimension &along = header.dimensions[variable.dimensions[0]];
      if (along.name != name || along.n < 2 || !is_number(variable.type))
        return stated;
      require_plain(file, variable, {"scale_factor", "add_offset"});
      const double rise   = rise_of(file, variable, along);
      const auto   n      = static_cast<double>(along.n);
      const double step   = rise / (n - 1);
      const double length = stated.value_or(n * step);
      // Coordinates that are all equal were never written.
      if (rise == 0)
        return stated;
      if (rise < 0 || !(std::abs((n - .5) * step - length) <=
                        .6 * std::abs(step) + .01 * std::abs(length)))
        reject_for_import(file,
                          "has coordinates '" + name +
                            "' that do not rise in steps of its length");
      const bool is_span = std::abs(length - rise) <= .01 * step;
      return is_span || (!stated && !variable.unit(file).empty()) ? n * step : stated;
    }

    /** Read the sides from the coordinate variables; none if one of them is unknown. */
    void
    read_sides(HeightMap           &map,
               const std::string   &file,
               const ClassicHeader &header,
               const std::string   &name_x,
               const std::string   &name_y)
    {
      const std::optional<double> lx = side_along(file, header, name_x);
      const std::optional<double> ly = side_along(file, header, name_y);
      if (!lx || !ly)
        return;
      const Variable   &x = header.variables.at(name_x), &y = header.variables.at(name_y);
      const std::string unit = x.unit(file);
      if (unit != y.unit(file))
        reject_for_import(file, "states different units for its sides");
      map.size         = {{*lx, *ly}};
      map.lateral_unit = parse_length_unit(unit);
      map.is_periodic  = x.says("periodic") && y.says("periodic");
    }

    /** The variable of the heights. Throws InputError if it is laid out differently. */
    const Variable &
    find_heights(const ClassicHeader &header, const std::string &file)
    {
      const auto found = header.variables.find("heights");
      if (found == header.variables.end() || found->second.dimensions.size() != 2 ||
          (found->second.type != type_double && found->second.type != type_float))
        reject_for_import(file, "has no two-dimensional variable 'heights'");
      require_plain(file,
                    found->second,
                    {"scale_factor",
                     "add_offset",
                     "missing_value",
                     "valid_min",
                     "valid_max",
                     "valid_range"});
      for (const std::uint64_t dimension : found->second.dimensions)
        if (dimension >= header.dimensions.size())
          reject_height_map(file, "has a damaged header: copy or import it again.");
        else if (header.dimensions[dimension].n == 0)
          reject_for_import(file, "has heights in records");
      return found->second;
    }
  } // namespace

  HeightMap
  read_netcdf(const std::string &file)
  {
    const ClassicHeader header(file);
    const Variable     &heights    = find_heights(header, file);
    const Dimension    &outer      = header.dimensions[heights.dimensions[0]];
    const Dimension    &inner      = header.dimensions[heights.dimensions[1]];
    const bool          x_is_outer = outer.name == "x" || outer.name == "X";
    if (heights.attributes.count("_FillValue") > 0 && !heights["_FillValue"].number)
      reject_for_import(file, "has a _FillValue that is not one number");
    // In the precision of the stored values, whatever that of the attribute is.
    const double stated = heights["_FillValue"].number.value_or(usual_fill);
    const double fill  = heights.type == type_float ? static_cast<float>(stated) : stated;
    const auto   value = [&](const char *bytes) {
      const double number = decode(bytes, heights.type);
      return number == fill ? std::numeric_limits<double>::quiet_NaN() : number;
    };
    HeightMap         map  = read_values(file,
                                {x_is_outer ? outer.n : inner.n,
                                 x_is_outer ? inner.n : outer.n,
                                 x_is_outer,
                                 heights.begin,
                                 bytes_of(heights.type),
                                 value});
    const std::string x    = x_is_outer ? outer.name : inner.name;
    std::string       unit = heights.unit(file);
    // In files of contact.engineering, the coordinates state the unit of all lengths.
    if (const auto found = header.variables.find(x);
        unit.empty() && found != header.variables.end())
      unit = found->second["length_unit"].text;
    map.height_unit = parse_length_unit(unit);
    map.format      = "NetCDF";
    read_sides(map, file, header, x, x_is_outer ? inner.name : outer.name);
    return map;
  }
} // namespace strait
