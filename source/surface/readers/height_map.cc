// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>
#include <strait/base/contact_parameters.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/surface/readers/height_map.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace strait
{
  namespace
  {
    /** The first 512 bytes of a file, or fewer if it is shorter. */
    std::string
    start_of(const std::string &file)
    {
      std::error_code error;
      if (!std::filesystem::exists(file, error))
        reject_height_map(file, "does not exist: check Surface/File.");
      if (!std::filesystem::is_regular_file(file, error))
        reject_height_map(file, "is not a file: check Surface/File.");
      std::ifstream stream(file, std::ios::binary);
      if (!stream)
        reject_height_map(file, "cannot be opened: check that you may read it.");
      std::string start(512, '\0');
      stream.read(start.data(), static_cast<std::streamsize>(start.size()));
      start.resize(static_cast<std::size_t>(stream.gcount()));
      return start;
    }

    HeightMap
    read_by_content(const std::string &file, const std::string &start)
    {
      if (boost::starts_with(start, "\x93NUMPY"))
        return read_npy(file);
      if (boost::starts_with(start, "CDF\x01") || boost::starts_with(start, "CDF\x02"))
        return read_netcdf(file);
      if (start.find('\0') == std::string::npos)
        return read_matrix_text(file);
      reject_for_import(file, "is no map that strait reads itself");
    }

    void
    check_values(const HeightMap &map, const std::string &file)
    {
      for (std::size_t i = 0; i < map.values.size(); ++i)
        if (std::abs(map.values[i]) > largest_magnitude)
          reject_height_map(file,
                            "has " +
                              std::string(std::isinf(map.values[i])
                                            ? "an infinite value"
                                            : "a value above 1e30") +
                              " in row " + std::to_string(i / map.nx) + ", column " +
                              std::to_string(i % map.nx) +
                              " (counted from 0): mark missing points as nan.");
      if (map.n_missing() == map.values.size())
        reject_height_map(file, "has no valid point at all: check what was exported.");
      if (map.size)
        for (const double side : *map.size)
          if (!(side > 0.) || !std::isfinite(side))
            reject_height_map(file,
                              "states a size that is not positive: mend its header or "
                              "export it again.");
    }
  } // namespace

  std::size_t
  HeightMap::n_missing() const
  {
    return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](const double value) {
        return std::isnan(value);
      }));
  }

  HeightMap
  read_height_map(const std::string &file)
  {
    const std::string start = start_of(file);
    if (start.empty())
      reject_height_map(file, "is empty: copy or export it again.");
    HeightMap map = read_by_content(file, start);
    map.file      = file;
    check_values(map, file);
    return map;
  }

  void
  reject_height_map(const std::string &file, const std::string &complaint)
  {
    throw InputError("The height map '" + file + "' " + complaint);
  }

  void
  reject_for_import(const std::string &file, const std::string &complaint)
  {
    const auto quoted = [](const std::string &path) {
      return path.find_first_of(" '\"()&;$") == std::string::npos ? path
                                                                  : "'" + path + "'";
    };
    const std::string     script = find_script("strait_import");
    std::filesystem::path map    = file;
    map.replace_extension(map.extension() == ".nc" ? ".map.nc" : ".nc");
    reject_height_map(file,
                      complaint + ": type \"" +
                        quoted(script.empty() ? "strait_import" : script) + " " +
                        quoted(file) + " -o " + quoted(map.string()) +
                        "\" and set Surface/File = " + map.string());
  }

  HeightMap
  read_values(const std::string &file, const StoredValues &stored)
  {
    const auto &[n_columns, n_rows, by_columns, begin, item_size, decode] = stored;
    constexpr std::uint64_t most = most_grid_points;
    const std::string       claim =
      std::to_string(n_columns) + " x " + std::to_string(n_rows) + " points";
    if (n_columns == 0 || n_rows == 0 || n_columns > most || n_rows > most)
      reject_height_map(file,
                        "has " + claim + ", and both must lie between 1 and " +
                          std::to_string(most) + ": cut or thin it out.");
    const std::uint64_t n_bytes = std::filesystem::file_size(file);
    if (n_columns * n_rows > (n_bytes - std::min(n_bytes, begin)) / item_size)
      reject_height_map(file,
                        "promises " + claim +
                          " and is too short for them: copy or export it again.");
    HeightMap map;
    map.nx = static_cast<int>(n_columns);
    map.ny = static_cast<int>(n_rows);
    map.values.resize(n_columns * n_rows);
    const std::size_t n_lines = by_columns ? n_columns : n_rows;
    const std::size_t n_items = by_columns ? n_rows : n_columns;
    std::vector<char> line(n_items * item_size);
    std::ifstream     stream(file, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(begin));
    for (std::size_t i = 0; i < n_lines; ++i)
      {
        stream.read(line.data(), static_cast<std::streamsize>(line.size()));
        if (!stream)
          reject_height_map(file, "cannot be read to its end: copy it again.");
        for (std::size_t j = 0; j < n_items; ++j)
          map.values[by_columns ? j * n_lines + i : i * n_items + j] =
            decode(line.data() + j * item_size);
      }
    return map;
  }
} // namespace strait
