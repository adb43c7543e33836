// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>
#include <strait/surface/readers/netcdf_header.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    // What the NetCDF library fills in for values that were never written.
    constexpr double usual_fill = 9.969209968386869e36;

    using Variable  = NetcdfHeader::Variable;
    using Dimension = NetcdfHeader::Dimension;

    /** Whether the attribute @p name of @p variable is 1 or a word for yes. */
    bool
    says(const Variable &variable, const std::string &name)
    {
      const auto       &attribute = variable[name];
      const std::string word      = boost::to_lower_copy(attribute.text);
      return attribute.number == 1. || word == "true" || word == "yes" || word == "1";
    }

    /** The unit of @p variable; empty if none is stated. Throws InputError about @p file
     *  if two units of different lengths are. */
    std::string
    unit_of(const Variable &variable, const std::string &file)
    {
      std::string unit;
      for (const char *name : {"unit", "units", "length_unit"})
        if (const std::string &text = variable[name].text; unit.empty())
          unit = text;
        else if (!text.empty() &&
                 parse_length_unit(text).metres != parse_length_unit(unit).metres)
          reject_for_import(file, "states two units, '" + unit + "' and '" + text + "'");
      return unit;
    }

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
      const auto decode_one = [&](const char *at) { return variable.decode(at); };
      const std::vector<double> x =
        read_values(file,
                    {along.n, 1, false, variable.begin, variable.item_size(), decode_one})
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
    side_along(const std::string  &file,
               const NetcdfHeader &header,
               const std::string  &name)
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
      if (along.name != name || along.n < 2 || !variable.is_number())
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
      return is_span || (!stated && !unit_of(variable, file).empty()) ? n * step : stated;
    }

    /** Read the sides from the coordinate variables; none if one of them is unknown. */
    void
    read_sides(HeightMap          &map,
               const std::string  &file,
               const NetcdfHeader &header,
               const std::string  &name_x,
               const std::string  &name_y)
    {
      const std::optional<double> lx = side_along(file, header, name_x);
      const std::optional<double> ly = side_along(file, header, name_y);
      if (!lx || !ly)
        return;
      const Variable   &x = header.variables.at(name_x), &y = header.variables.at(name_y);
      const std::string unit = unit_of(x, file);
      if (unit != unit_of(y, file))
        reject_for_import(file, "states different units for its sides");
      map.size         = {{*lx, *ly}};
      map.lateral_unit = parse_length_unit(unit);
      map.is_periodic  = says(x, "periodic") && says(y, "periodic");
    }

    /** The variable of the heights. Throws InputError if it is laid out differently. */
    const Variable &
    find_heights(const NetcdfHeader &header, const std::string &file)
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
    const NetcdfHeader header(file);
    const Variable    &heights    = find_heights(header, file);
    const Dimension   &outer      = header.dimensions[heights.dimensions[0]];
    const Dimension   &inner      = header.dimensions[heights.dimensions[1]];
    const bool         x_is_outer = outer.name == "x" || outer.name == "X";
    if (heights.attributes.count("_FillValue") > 0 && !heights["_FillValue"].number)
      reject_for_import(file, "has a _FillValue that is not one number");
    // In the precision of the stored values, whatever that of the attribute is.
    const double stated = heights["_FillValue"].number.value_or(usual_fill);
    const double fill  = heights.type == type_float ? static_cast<float>(stated) : stated;
    const auto   value = [&](const char *bytes) {
      const double number = heights.decode(bytes);
      return number == fill ? std::numeric_limits<double>::quiet_NaN() : number;
    };
    HeightMap         map  = read_values(file,
                                {x_is_outer ? outer.n : inner.n,
                                 x_is_outer ? inner.n : outer.n,
                                 x_is_outer,
                                 heights.begin,
                                 heights.item_size(),
                                 value});
    const std::string x    = x_is_outer ? outer.name : inner.name;
    std::string       unit = unit_of(heights, file);
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
