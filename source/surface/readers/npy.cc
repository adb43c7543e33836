// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace strait
{
  namespace
  {
    constexpr auto little = boost::endian::order::little;

    /** The text of the dictionary; sets header.begin. */
    std::string
    read_dictionary(std::ifstream &stream, const std::string &file, StoredValues &header)
    {
      char start[12] = {};
      stream.read(start, 8);
      const int version      = static_cast<unsigned char>(start[6]);
      const int length_bytes = version == 1 ? 2 : 4;
      if (!stream || version < 1 || version > 3)
        reject_height_map(file, "is a .npy file of an unknown version: save it again.");
      stream.read(start + 8, length_bytes);
      const std::uint64_t length = version == 1 ? load<std::uint16_t, little>(start + 8)
                                                : load<std::uint32_t, little>(start + 8);
      header.begin               = 8 + length_bytes + length;
      if (!stream || header.begin > std::filesystem::file_size(file))
        reject_height_map(file, "ends within its header: copy or save it again.");
      // numpy allows no more, and std::regex recurses with every character.
      constexpr std::uint64_t longest_dictionary = 10000;
      if (length > longest_dictionary)
        reject_height_map(file, "has too long a header: save a plain array.");
      std::string dictionary(length, ' ');
      stream.read(dictionary.data(), static_cast<std::streamsize>(length));
      return dictionary;
    }

    /** Read what the dictionary at the start of the file states. */
    StoredValues
    read_header(const std::string &file)
    {
      std::ifstream     stream(file, std::ios::binary);
      StoredValues      header;
      const std::string dictionary = read_dictionary(stream, file, header);

      std::smatch             match;
      static const std::regex type("'descr': *'([^']*)'");
      if (!std::regex_search(dictionary, match, type))
        reject_height_map(file, "has no single data type: save a plain array.");
      static const std::map<std::string, decltype(header.decode)> decoders = {
        {"<f4", load<float, little>},
        {"<f8", load<double, little>},
        {"<i2", load<std::int16_t, little>},
        {"<i4", load<std::int32_t, little>},
        {"<i8", load<std::int64_t, little>}};
      const auto decoder = decoders.find(match[1]);
      if (decoder == decoders.end())
        reject_height_map(file,
                          "has the data type '" + match[1].str() +
                            "', and only <f4, <f8, <i2, <i4 and <i8 are supported: "
                            "convert it with astype('<f8').");
      header.item_size = decoder->first[2] - '0';
      header.decode    = decoder->second;

      static const std::regex shape("'shape': *\\( *([0-9]+) *, *([0-9]+) *,? *\\)");
      if (!std::regex_search(dictionary, match, shape))
        reject_height_map(file,
                          "is not two-dimensional: save an array of shape (Ny, Nx).");
      // Ten digits fit into 64 bits, and no grid has more points along a side.
      const auto extent = [](const std::string &digits) -> std::uint64_t {
        return digits.size() > 10 ? 0 : std::stoull(digits);
      };
      header.n_rows    = extent(match[1]);
      header.n_columns = extent(match[2]);

      static const std::regex fortran("'fortran_order': *True");
      header.by_columns = std::regex_search(dictionary, fortran);
      return header;
    }
  } // namespace

  HeightMap
  read_npy(const std::string &file)
  {
    const StoredValues header = read_header(file);
    HeightMap          map    = read_values(file, header);
    if (std::filesystem::file_size(file) !=
        header.begin + map.values.size() * header.item_size)
      reject_height_map(file, "holds more than it promises: copy or save it again.");
    map.format = ".npy";
    return map;
  }
} // namespace strait
