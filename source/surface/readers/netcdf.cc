// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/readers/formats.h>
#include <strait/surface/readers/netcdf_file.h>

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

namespace strait
{
  namespace
  {
    std::string
    variable_name(const int file, const int variable)
    {
      char name[NC_MAX_NAME + 1] = {};
      nc_inq_varname(file, variable, name);
      return name;
    }

    bool
    is_map(const int file, const int variable)
    {
      int     n_dimensions = 0;
      nc_type type         = NC_NAT;
      nc_inq_varndims(file, variable, &n_dimensions);
      nc_inq_vartype(file, variable, &type);
      return n_dimensions == 2 && type != NC_CHAR && type <= NC_UINT64 &&
             type != NC_STRING;
    }

    int
    choose_variable(const int file, const MapSource &source)
    {
      int n_variables = 0;
      nc_inq_nvars(file, &n_variables);
      std::vector<std::string> names;
      int                      found = -1;
      for (int variable = 0; variable < n_variables; ++variable)
        if (is_map(file, variable))
          {
            names.push_back(variable_name(file, variable));
            if (found < 0 || names.back() == "heights")
              found = variable;
          }
      if (!source.dataset.empty())
        {
          int named = -1;
          if (nc_inq_varid(file, source.dataset.c_str(), &named) == NC_NOERR &&
              is_map(file, named))
            return named;
          reject_height_map(source.file,
                            "has no two-dimensional variable '" + source.dataset +
                              "': set Surface/Dataset to one of " + join(names, ", ") +
                              ".");
        }
      if (names.empty())
        reject_height_map(source.file,
                          "holds no two-dimensional variable of numbers: check "
                          "Surface/File.");
      if (names.size() > 1 && variable_name(file, found) != "heights")
        reject_height_map(source.file,
                          "holds several variables: set Surface/Dataset to one of " +
                            join(names, ", ") + ".");
      return found;
    }

    /** A side of the map. */
    struct Dimension
    {
      int         id = -1;
      std::string name;
      std::size_t n = 0;
    };

    Dimension
    dimension(const int file, const int id)
    {
      char        name[NC_MAX_NAME + 1] = {};
      std::size_t n                     = 0;
      nc_inq_dim(file, id, name, &n);
      return {id, name, n};
    }

    /** What the coordinate variable of a side says of it. */
    struct Side
    {
      std::optional<double> length;
      LengthUnit            unit;
      bool                  is_periodic = false;
    };

    Side
    read_side(const int file, const Dimension &along)
    {
      int variable = -1;
      if (nc_inq_varid(file, along.name.c_str(), &variable) != NC_NOERR)
        return {};
      Side side;
      side.unit        = unit_attribute(file, variable);
      side.length      = number_attribute(file, variable, "length");
      side.is_periodic = number_attribute(file, variable, "periodic").value_or(0.) != 0.;
      if (!side.length && along.n > 1)
        {
          const std::size_t first = 0, last = along.n - 1;
          double            begin = 0., end = 0.;
          if (nc_get_var1_double(file, variable, &first, &begin) == NC_NOERR &&
              nc_get_var1_double(file, variable, &last, &end) == NC_NOERR)
            side.length = std::abs(end - begin) / static_cast<double>(last) *
                          static_cast<double>(along.n);
        }
      return side;
    }

    void
    read_sides(HeightMap         &map,
               const int          file,
               const Dimension   &x,
               const Dimension   &y,
               const std::string &name)
    {
      const Side along_x = read_side(file, x), along_y = read_side(file, y);
      map.is_periodic = along_x.is_periodic && along_y.is_periodic;
      if (!along_x.length || !along_y.length)
        return;
      if (along_x.unit.metres != along_y.unit.metres)
        reject_height_map(name,
                          "states different units for its sides, '" + along_x.unit.name +
                            "' and '" + along_y.unit.name + "': make them alike.");
      map.size         = {{*along_x.length, *along_y.length}};
      map.lateral_unit = along_x.unit;
    }

    /** Fill values become NaN; scale and offset are applied. */
    void
    interpret(std::vector<double> &values, const int file, const int variable)
    {
      int    no_fill = 0;
      double fill    = std::numeric_limits<double>::quiet_NaN();
      // The default fill value of floating-point types marks missing points as well.
      nc_type type = NC_NAT;
      nc_inq_vartype(file, variable, &type);
      if (const auto stated = number_attribute(file, variable, "_FillValue"))
        fill = *stated;
      else if (type == NC_DOUBLE && nc_inq_var_fill(file, variable, &no_fill, &fill) == 0)
        fill = NC_FILL_DOUBLE;
      else if (type == NC_FLOAT)
        fill = static_cast<double>(NC_FILL_FLOAT);
      const auto   other  = number_attribute(file, variable, "missing_value");
      const double scale  = number_attribute(file, variable, "scale_factor").value_or(1.);
      const double offset = number_attribute(file, variable, "add_offset").value_or(0.);
      for (double &value : values)
        if (value == fill || (other && value == *other))
          value = std::numeric_limits<double>::quiet_NaN();
        else
          value = value * scale + offset;
    }

    std::vector<double>
    transposed(const std::vector<double> &values, const std::size_t n_rows)
    {
      const std::size_t   n_columns = values.size() / n_rows;
      std::vector<double> result(values.size());
      for (std::size_t row = 0; row < n_rows; ++row)
        for (std::size_t column = 0; column < n_columns; ++column)
          result[column * n_rows + row] = values[row * n_columns + column];
      return result;
    }

    /** Bytes that a variable can have at most, for what the file holds of it. */
    std::uint64_t
    largest_content(const int file, const int variable, const std::string &name)
    {
      int format = 0;
      nc_inq_format(file, &format);
      const std::uint64_t bytes = std::filesystem::file_size(name);
      if (format == NC_FORMAT_NETCDF4 || format == NC_FORMAT_NETCDF4_CLASSIC)
        return largest_compression * bytes;
      const std::uint64_t begin =
        begin_of_classic_variable(name, variable).value_or(bytes);
      return begin < bytes ? bytes - begin : 0;
    }
  } // namespace

  bool
  is_netcdf4(const std::string &name)
  {
    // Any HDF5 file can be opened; only those of the library carry its name.
    const NetcdfFile file(name);
    int              length = 0;
    if (!file.is_open)
      return false;
    std::size_t size = 0;
    if (nc_inq_attlen(file.id, NC_GLOBAL, "_NCProperties", &size) == NC_NOERR)
      return true;
    return nc_inq_ndims(file.id, &length) == NC_NOERR && length > 0 &&
           std::filesystem::path(name).extension() == ".nc";
  }

  HeightMap
  read_netcdf(const MapSource &source)
  {
    const NetcdfFile file(source.file);
    if (!file.is_open)
      reject_height_map(source.file,
                        "is damaged or no NetCDF file: copy or export it again.");
    const int          variable = choose_variable(file.id, source);
    std::array<int, 2> ids{};
    nc_inq_vardimid(file.id, variable, ids.data());
    const Dimension outer = dimension(file.id, ids[0]),
                    inner = dimension(file.id, ids[1]);

    nc_type     type      = NC_NAT;
    std::size_t item_size = 8;
    nc_inq_vartype(file.id, variable, &type);
    nc_inq_type(file.id, type, nullptr, &item_size);
    check_claim(source.file,
                inner.n,
                outer.n,
                item_size,
                largest_content(file.id, variable, source.file));
    std::vector<double> values(inner.n * outer.n);
    if (nc_get_var_double(file.id, variable, values.data()) != NC_NOERR)
      reject_height_map(source.file,
                        "cannot be read to its end: copy or export it again.");

    HeightMap  map;
    const bool x_is_outer = outer.name == "x";
    map.nx                = static_cast<int>(x_is_outer ? outer.n : inner.n);
    map.ny                = static_cast<int>(x_is_outer ? inner.n : outer.n);
    map.values            = x_is_outer ? transposed(values, outer.n) : std::move(values);
    interpret(map.values, file.id, variable);
    map.height_unit = unit_attribute(file.id, variable);
    read_sides(
      map, file.id, x_is_outer ? outer : inner, x_is_outer ? inner : outer, source.file);
    return map;
  }
} // namespace strait
