// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/readers/binary.h>
#include <strait/surface/readers/formats.h>
#include <strait/surface/readers/text_header.h>

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
    constexpr double none = std::numeric_limits<double>::quiet_NaN();

    struct SdfHeader
    {
      std::uint64_t n_points    = 0; // along x
      std::uint64_t n_profiles  = 0;
      double        x_scale     = 0.; // metres
      double        y_scale     = 0.;
      double        z_scale     = 0.;
      int           compression = 0;
      int           data_type   = 7;
    };

    HeightMap
    empty_map(const SdfHeader &header)
    {
      HeightMap map;
      map.nx           = static_cast<int>(header.n_points);
      map.ny           = static_cast<int>(header.n_profiles);
      map.size         = {{header.x_scale * map.nx, header.y_scale * map.ny}};
      map.lateral_unit = {"m", 1.};
      map.height_unit  = {"m", 1.};
      return map;
    }

    // The ASCII form: lines NAME = VALUE, a line *, numbers, and perhaps * and more.

    double
    number_of(const std::map<std::string, std::string> &fields,
              const std::string                        &name,
              const std::string                        &file)
    {
      const auto field = fields.find(name);
      if (field != fields.end())
        {
          const char       *position = field->second.data();
          const char *const end      = position + field->second.size();
          const auto        value    = read_number(position, end);
          if (value && position == end && std::isfinite(*value))
            return *value;
        }
      reject_height_map(file,
                        "lacks a number '" + name +
                          "' in its SDF header: export it again.");
    }

    std::uint64_t
    count_of(const std::map<std::string, std::string> &fields,
             const std::string                        &name,
             const std::string                        &file)
    {
      const double value = number_of(fields, name, file);
      return value >= 0 && value < 1e9 ? static_cast<std::uint64_t>(value) : 0;
    }

    SdfHeader
    read_ascii_header(std::ifstream &stream, const std::string &file)
    {
      std::map<std::string, std::string> fields;
      std::string                        line;
      std::getline(stream, line); // the magic
      while (std::getline(stream, line) && trim(line) != "*")
        {
          const std::size_t equals = line.find('=');
          if (equals != std::string::npos && line.size() < 1000 && fields.size() < 1000)
            fields[trim(line.substr(0, equals))] = trim(line.substr(equals + 1));
        }
      if (!stream)
        reject_height_map(file, "ends within its header: copy or export it again.");
      SdfHeader header;
      header.n_points   = count_of(fields, "NumPoints", file);
      header.n_profiles = count_of(fields, "NumProfiles", file);
      header.x_scale    = number_of(fields, "Xscale", file);
      header.y_scale    = number_of(fields, "Yscale", file);
      header.z_scale    = number_of(fields, "Zscale", file);
      return header;
    }

    HeightMap
    read_ascii(const std::string &file)
    {
      std::ifstream   stream(file, std::ios::binary);
      const SdfHeader header = read_ascii_header(stream, file);
      // Each number takes two characters at the least.
      check_claim(file,
                  header.n_points,
                  header.n_profiles,
                  2,
                  std::filesystem::file_size(file) + 1);
      HeightMap         map      = empty_map(header);
      const std::size_t n_values = header.n_points * header.n_profiles;
      map.values.reserve(n_values);
      std::string word;
      while (map.values.size() < n_values && stream >> word && word != "*")
        {
          const char       *position = word.data();
          const char *const end      = position + word.size();
          const auto        value    = read_number(position, end);
          if (word == "BAD" || word == "bad")
            map.values.push_back(none);
          else if (value && position == end)
            map.values.push_back(*value * header.z_scale);
          else
            reject_height_map(file,
                              "has '" + word.substr(0, 30) +
                                "' among its numbers: mend or export it again.");
        }
      if (map.values.size() < n_values)
        reject_height_map(file,
                          "promises " + std::to_string(n_values) + " values and holds " +
                            std::to_string(map.values.size()) +
                            ": copy or export it again.");
      return map;
    }

    // The binary form: 81 bytes of header, then the numbers, little-endian.

    constexpr std::size_t header_bytes = 81;

    /** A number type of the standard, and its value for missing points. */
    struct SdfType
    {
      NumberType type;
      double     missing;
    };

    SdfType
    type_of(const SdfHeader &header, const std::string &file)
    {
      switch (header.data_type)
        {
          case 0:
            return {NumberType::uint8, none};
          case 1:
            return {NumberType::uint16, 65535.};
          case 2:
            return {NumberType::uint32, 4294967295.};
          case 3:
            return {NumberType::float32, none};
          case 4:
            return {NumberType::int8, none};
          case 5:
            return {NumberType::int16, -32768.};
          case 6:
            return {NumberType::int32, -2147483648.};
          case 7:
            return {NumberType::float64, none};
          default:
            reject_height_map(file,
                              "has data of the unknown type " +
                                std::to_string(header.data_type) +
                                ": export it as text.");
        }
    }

    SdfHeader
    read_binary_header(std::ifstream &stream, const std::string &file)
    {
      char bytes[header_bytes] = {};
      if (!stream.read(bytes, header_bytes))
        reject_height_map(file, "ends within its header: copy or export it again.");
      constexpr std::size_t after_dates = 8 + 10 + 12 + 12;
      const auto            real        = [&bytes](const std::size_t index) {
        return decode(NumberType::float64, bytes + after_dates + 4 + 8 * index);
      };
      SdfHeader header;
      header.n_points =
        static_cast<std::uint64_t>(decode(NumberType::uint16, bytes + after_dates));
      header.n_profiles =
        static_cast<std::uint64_t>(decode(NumberType::uint16, bytes + after_dates + 2));
      header.x_scale     = real(0);
      header.y_scale     = real(1);
      header.z_scale     = real(2);
      header.compression = static_cast<unsigned char>(bytes[header_bytes - 3]);
      header.data_type   = static_cast<unsigned char>(bytes[header_bytes - 2]);
      return header;
    }

    HeightMap
    read_binary(const std::string &file)
    {
      std::ifstream   stream(file, std::ios::binary);
      const SdfHeader header = read_binary_header(stream, file);
      if (header.compression != 0)
        reject_height_map(file, "holds compressed data: export it without compression.");
      const SdfType type = type_of(header, file);
      check_claim(file,
                  header.n_points,
                  header.n_profiles,
                  bytes_of(type.type),
                  std::filesystem::file_size(file) - header_bytes);
      HeightMap map = empty_map(header);
      map.values = read_numbers(stream, type.type, header.n_points * header.n_profiles);
      if (!stream)
        reject_height_map(file, "cannot be read to its end: copy it again.");
      for (double &value : map.values)
        value = value == type.missing ? none : value * header.z_scale;
      return map;
    }
  } // namespace

  bool
  is_sdf(const std::string &start)
  {
    for (const char *magic :
         {"aISO-1.0", "aBCR-1.0", "aNIST-1.0", "bISO-1.0", "bBCR-1.0"})
      if (start.compare(0, std::string(magic).size(), magic) == 0)
        return true;
    return false;
  }

  HeightMap
  read_sdf(const std::string &file)
  {
    char          first = 0;
    std::ifstream stream(file, std::ios::binary);
    stream.get(first);
    return first == 'b' ? read_binary(file) : read_ascii(file);
  }
} // namespace strait
