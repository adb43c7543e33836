// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/netcdf_file.h>

#include <netcdf.h>

namespace strait
{
  NetcdfFile::NetcdfFile(const std::string &name)
    : is_open(nc_open(name.c_str(), NC_NOWRITE, &id) == NC_NOERR)
  {
  }

  NetcdfFile::~NetcdfFile()
  {
    if (is_open)
      nc_close(id);
  }

  std::optional<double>
  number_attribute(const int file, const int variable, const char *name)
  {
    nc_type     type   = NC_NAT;
    std::size_t length = 0;
    double      value  = 0.;
    if (nc_inq_att(file, variable, name, &type, &length) != NC_NOERR || type == NC_CHAR ||
        length != 1 || nc_get_att_double(file, variable, name, &value) != NC_NOERR)
      return {};
    return value;
  }

  std::string
  text_attribute(const int file, const int variable, const char *name)
  {
    nc_type     type   = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(file, variable, name, &type, &length) != NC_NOERR)
      return {};
    if (type == NC_STRING && length == 1)
      {
        char *text = nullptr;
        if (nc_get_att_string(file, variable, name, &text) != NC_NOERR || text == nullptr)
          return {};
        const std::string result = text;
        nc_free_string(1, &text);
        return result;
      }
    std::string text(length, '\0');
    if (type != NC_CHAR || nc_get_att_text(file, variable, name, text.data()) != NC_NOERR)
      return {};
    return text.substr(0, text.find('\0'));
  }

  LengthUnit
  unit_attribute(const int file, const int variable)
  {
    const std::string unit = text_attribute(file, variable, "unit");
    return parse_length_unit(unit.empty() ? text_attribute(file, variable, "units")
                                          : unit);
  }
} // namespace strait
