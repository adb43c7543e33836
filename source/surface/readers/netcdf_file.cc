// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/netcdf_file.h>

#include <netcdf.h>

#include <array>
#include <fstream>

namespace strait
{
  namespace
  {
    /** Walks through a header; all numbers are big-endian, all parts padded to 4 bytes.
     */
    class Cursor
    {
    public:
      explicit Cursor(const std::string &file)
        : stream(file, std::ios::binary)
      {
        std::array<char, 4> magic{};
        stream.read(magic.data(), 4);
        version = magic[3];
      }

      std::uint64_t
      number(const int n_bytes)
      {
        std::uint64_t value = 0;
        for (int i = 0; i < n_bytes; ++i)
          value = value << 8 | static_cast<unsigned char>(stream.get());
        return value;
      }

      /** A count, a length or an identifier. */
      std::uint64_t
      count()
      {
        return number(version == 5 ? 8 : 4);
      }

      /** A place in the file. */
      std::uint64_t
      offset()
      {
        return number(version == 1 ? 4 : 8);
      }

      void
      skip(const std::uint64_t n_bytes)
      {
        stream.ignore(static_cast<std::streamsize>((n_bytes + 3) / 4 * 4));
      }

      void
      skip_name()
      {
        skip(count());
      }

      void
      skip_attributes()
      {
        number(4); // what kind of list this is
        for (std::uint64_t n = count(); n > 0 && stream; --n)
          {
            skip_name();
            const std::uint64_t type         = number(4);
            constexpr int       item_bytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
            skip(count() * (type < 12 ? item_bytes[type] : 0));
          }
      }

      std::ifstream stream;
      int           version = 0;
    };
  } // namespace

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

  std::optional<std::uint64_t>
  begin_of_classic_variable(const std::string &file, const int variable)
  {
    Cursor cursor(file);
    cursor.count(); // records
    cursor.number(4);
    for (std::uint64_t n = cursor.count(); n > 0 && cursor.stream; --n)
      {
        cursor.skip_name();
        cursor.count();
      }
    cursor.skip_attributes();
    cursor.number(4);
    const std::uint64_t n_variables = cursor.count();
    std::uint64_t       begin       = 0;
    for (int v = 0; v <= variable && cursor.stream; ++v)
      {
        cursor.skip_name();
        for (std::uint64_t n = cursor.count(); n > 0 && cursor.stream; --n)
          cursor.count();
        cursor.skip_attributes();
        cursor.number(4); // type
        cursor.count();   // size
        begin = cursor.offset();
      }
    if (!cursor.stream || static_cast<std::uint64_t>(variable) >= n_variables)
      return {};
    return begin;
  }
} // namespace strait
