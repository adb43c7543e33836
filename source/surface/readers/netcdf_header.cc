// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>
#include <strait/surface/readers/netcdf_header.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace strait
{
  namespace
  {
    constexpr auto big = boost::endian::order::big;

    bool
    is_a_number(const std::uint64_t type)
    {
      return type >= type_byte && type <= type_double && type != type_char;
    }

    std::uint64_t
    bytes_of(const std::uint64_t type)
    {
      constexpr std::uint64_t bytes[] = {1, 1, 1, 2, 4, 4, 8};
      return bytes[type <= type_double ? type : 0];
    }

    double
    decode_as(const std::uint64_t type, const char *bytes)
    {
      return type == type_double  ? load<double, big>(bytes)
             : type == type_int   ? load<std::int32_t, big>(bytes)
             : type == type_short ? load<std::int16_t, big>(bytes)
             : type == type_byte  ? load<std::int8_t, big>(bytes)
                                  : load<float, big>(bytes);
    }
  } // namespace

  const NetcdfHeader::Attribute &
  NetcdfHeader::Variable::operator[](const std::string &name) const
  {
    static const Attribute none;
    const auto             found = attributes.find(name);
    return found == attributes.end() ? none : found->second;
  }

  bool
  NetcdfHeader::Variable::is_number() const
  {
    return is_a_number(type);
  }

  std::uint64_t
  NetcdfHeader::Variable::item_size() const
  {
    return bytes_of(type);
  }

  double
  NetcdfHeader::Variable::decode(const char *bytes) const
  {
    return decode_as(type, bytes);
  }

  NetcdfHeader::NetcdfHeader(const std::string &file_)
    : file(file_)
  {
    std::ifstream stream(file, std::ios::binary);
    // Headers of maps have some hundred bytes; this leaves room for any history.
    constexpr std::uint64_t longest = 1 << 20;
    content.resize(std::min<std::uint64_t>(longest, std::filesystem::file_size(file)));
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
    const std::string magic            = take(4);
    const int         n_bytes_of_begin = magic[3] == 1 ? 4 : 8;
    number(4); // records, of which a map has none
    for (std::uint64_t n = length_of_list(); n > 0; --n)
      {
        const std::string name = text();
        dimensions.push_back({name, number(4)});
      }
    attributes();
    for (std::uint64_t n = length_of_list(); n > 0; --n)
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

  std::string
  NetcdfHeader::take(const std::uint64_t n_bytes)
  {
    if (n_bytes > content.size() - position)
      reject_height_map(file, "ends within its header: copy or import it again.");
    std::string bytes = content.substr(position, n_bytes);
    position += n_bytes;
    return bytes;
  }

  std::uint64_t
  NetcdfHeader::number(const int n_bytes)
  {
    const std::string bytes = take(static_cast<std::uint64_t>(n_bytes));
    return n_bytes == 4 ? load<std::uint32_t, big>(bytes.data())
                        : load<std::uint64_t, big>(bytes.data());
  }

  std::string
  NetcdfHeader::padded(const std::uint64_t n_bytes)
  {
    return take((n_bytes + 3) / 4 * 4).substr(0, n_bytes);
  }

  std::string
  NetcdfHeader::text()
  {
    return padded(number(4));
  }

  std::uint64_t
  NetcdfHeader::length_of_list()
  {
    number(4); // its tag
    return number(4);
  }

  std::map<std::string, NetcdfHeader::Attribute>
  NetcdfHeader::attributes()
  {
    std::map<std::string, Attribute> result;
    for (std::uint64_t n = length_of_list(); n > 0; --n)
      {
        const std::string   name = text();
        const std::uint64_t type = number(4), length = number(4);
        const std::string   bytes = padded(length * bytes_of(type));
        Attribute          &found = result[name];
        if (type == type_char)
          found.text = bytes.substr(0, bytes.find('\0'));
        else if (length == 1 && is_a_number(type))
          found.number = decode_as(type, bytes.data());
      }
    return result;
  }
} // namespace strait
