// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/readers/height_map.h>
#include <strait/surface/readers/matrix_text.h>
#include <strait/surface/readers/npy.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace strait
{
  namespace
  {
    /** The first bytes of @p file, fewer if it is shorter. */
    std::string
    first_bytes(const std::string &file, const std::size_t n_bytes)
    {
      std::error_code error;
      if (!std::filesystem::exists(file, error))
        reject_height_map(file, "does not exist: check Surface/File.");
      if (!std::filesystem::is_regular_file(file, error))
        reject_height_map(file, "is not a file: check Surface/File.");
      std::ifstream stream(file, std::ios::binary);
      if (!stream)
        reject_height_map(file, "cannot be opened: check that you may read it.");
      std::string bytes(n_bytes, '\0');
      stream.read(bytes.data(), static_cast<std::streamsize>(n_bytes));
      bytes.resize(static_cast<std::size_t>(stream.gcount()));
      return bytes;
    }

    void
    check_finite(const HeightMap &map, const std::string &file)
    {
      for (std::size_t i = 0; i < map.values.size(); ++i)
        if (!std::isfinite(map.values[i]))
          reject_height_map(file,
                            "has a value that is not finite in row " +
                              std::to_string(i / map.nx) + ", column " +
                              std::to_string(i % map.nx) +
                              " (counted from 0): fill in missing points first.");
    }
  } // namespace

  HeightMap
  read_height_map(const std::string &file)
  {
    if (file.empty())
      throw InputError(
        "Surface/File is empty: name a height map, or choose another "
        "Surface/Kind.");
    const std::string start = first_bytes(file, 512);
    const auto        is    = [&start](const std::string &magic) {
      return start.compare(0, magic.size(), magic) == 0;
    };

    HeightMap map;
    if (is(npy_magic))
      map = read_npy(file);
    else if (is("\x89HDF") || is("CDF"))
      reject_height_map(file,
                        "is an HDF5 or NetCDF file, which is not supported: export it as "
                        ".npy or matrix text.");
    else if (start.find('\0') != std::string::npos)
      reject_height_map(file,
                        "is neither a .npy file nor text: export it as one of them.");
    else
      map = read_matrix_text(file);
    check_finite(map, file);
    return map;
  }

  void
  reject_height_map(const std::string &file, const std::string &complaint)
  {
    throw InputError("The height map '" + file + "' " + complaint);
  }
} // namespace strait
