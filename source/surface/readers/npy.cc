// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>

#include <boost/endian/conversion.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <regex>

namespace strait
{
  namespace
  {
    /** What the dictionary at the start of the file says. */
    struct NpyHeader
    {
      std::string    type;              // "f8": of floating point with 8 bytes, "i2"
      int            item_size     = 0; // bytes
      bool           fortran_order = false;
      std::uint64_t  n_rows        = 0;
      std::uint64_t  n_columns     = 0;
      std::uintmax_t data_begin    = 0; // bytes from the start of the file
    };

    template <typename Number>
    Number
    little_endian(const char *bytes)
    {
      return boost::endian::
        endian_load<Number, sizeof(Number), boost::endian::order::little>(
          reinterpret_cast<const unsigned char *>(bytes));
    }

    /** A number of the type that the header names. */
    double
    decode(const NpyHeader &header, const char *bytes)
    {
      if (header.type == "f8")
        return little_endian<double>(bytes);
      if (header.type == "f4")
        return little_endian<float>(bytes);
      if (header.type == "i2")
        return little_endian<std::int16_t>(bytes);
      if (header.type == "i4")
        return little_endian<std::int32_t>(bytes);
      return static_cast<double>(little_endian<std::int64_t>(bytes));
    }

    /** The text of the dictionary; sets header.data_begin. */
    std::string
    read_dictionary(std::ifstream &stream, const std::string &file, NpyHeader &header)
    {
      char start[12] = {};
      stream.read(start, 8);
      const int version      = static_cast<unsigned char>(start[6]);
      const int length_bytes = version == 1 ? 2 : 4;
      if (!stream || version < 1 || version > 3)
        reject_height_map(file, "is a .npy file of an unknown version: save it again.");
      stream.read(start + 8, length_bytes);
      const std::uint64_t length = version == 1 ? little_endian<std::uint16_t>(start + 8)
                                                : little_endian<std::uint32_t>(start + 8);
      header.data_begin          = 8 + length_bytes + length;
      if (!stream || header.data_begin > std::filesystem::file_size(file))
        reject_height_map(file, "ends within its header: copy or save it again.");
      // numpy admits no more, and a regular expression recurses with every letter.
      constexpr std::uint64_t longest_dictionary = 10000;
      if (length > longest_dictionary)
        reject_height_map(file, "has too long a header: save a plain array.");
      std::string dictionary(length, ' ');
      stream.read(dictionary.data(), static_cast<std::streamsize>(length));
      return dictionary;
    }

    NpyHeader
    read_header(std::ifstream &stream, const std::string &file)
    {
      NpyHeader         header;
      const std::string dictionary = read_dictionary(stream, file, header);

      std::smatch             match;
      static const std::regex type("'descr': *'([^']*)'");
      if (!std::regex_search(dictionary, match, type))
        reject_height_map(file, "has no single data type: save a plain array.");
      static const std::regex supported("<(f[48]|i[248])");
      const std::string       type_name = match[1];
      if (!std::regex_match(type_name, supported))
        reject_height_map(file,
                          "has the data type '" + type_name +
                            "', and only <f4, <f8, <i2, <i4 and <i8 are supported: "
                            "convert it with astype('<f8').");
      header.type      = type_name.substr(1);
      header.item_size = header.type[1] - '0';

      static const std::regex shape("'shape': *\\( *([0-9]+) *, *([0-9]+) *,? *\\)");
      if (!std::regex_search(dictionary, match, shape))
        reject_height_map(file,
                          "is not two-dimensional: save an array of shape (Ny, Nx).");
      // Ten digits fit into 64 bits and are more than any grid has.
      const auto extent = [](const std::string &digits) -> std::uint64_t {
        return digits.size() > 10 ? 0 : std::stoull(digits);
      };
      header.n_rows    = extent(match[1]);
      header.n_columns = extent(match[2]);

      static const std::regex fortran("'fortran_order': *True");
      header.fortran_order = std::regex_search(dictionary, fortran);
      return header;
    }
  } // namespace

  HeightMap
  read_npy(const std::string &file)
  {
    std::ifstream   stream(file, std::ios::binary);
    const NpyHeader header  = read_header(stream, file);
    const auto      n_bytes = std::filesystem::file_size(file) - header.data_begin;
    check_claim(file, header.n_columns, header.n_rows, header.item_size, n_bytes);
    if (n_bytes != header.n_rows * header.n_columns * header.item_size)
      reject_height_map(file, "holds more than it promises: copy or save it again.");

    HeightMap map;
    map.format = ".npy";
    map.nx     = static_cast<int>(header.n_columns);
    map.ny     = static_cast<int>(header.n_rows);
    map.values.resize(header.n_rows * header.n_columns);

    // A line is a row in C order and a column in Fortran order.
    const std::size_t n_lines = header.fortran_order ? header.n_columns : header.n_rows;
    const std::size_t n_items = header.fortran_order ? header.n_rows : header.n_columns;
    const std::size_t line_stride = header.fortran_order ? 1 : header.n_columns;
    const std::size_t item_stride = header.fortran_order ? header.n_columns : 1;

    std::vector<char> bytes(n_items * header.item_size);
    for (std::size_t line = 0; line < n_lines; ++line)
      {
        stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        if (!stream)
          reject_height_map(file, "cannot be read to its end: copy or save it again.");
        for (std::size_t item = 0; item < n_items; ++item)
          map.values[line * line_stride + item * item_stride] =
            decode(header, bytes.data() + item * header.item_size);
      }
    return map;
  }
} // namespace strait
