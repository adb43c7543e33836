// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/readers/formats.h>
#include <strait/surface/readers/isolated_reader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace strait
{
  namespace
  {
    // The first bytes of .npy and HDF5 files, and of zip archives.
    constexpr char npy_magic[] = "\x93NUMPY", hdf5_magic[] = "\x89HDF",
                   zip_magic[] = "PK\x03\x04";

    /** What the choice of a reader depends on. */
    struct Evidence
    {
      std::string start; // first bytes of the file
      std::string extension;
      std::string file;

      bool
      starts_with(const std::string &magic) const
      {
        return start.compare(0, magic.size(), magic) == 0;
      }
    };

    /** A format: its name, how to know it, how to read it. */
    struct Reader
    {
      MapFormat   format;
      const char *name;
      bool (*recognises)(const Evidence &);
      HeightMap (*read)(const MapSource &);
    };

    /** The first that recognises a file reads it; text takes whatever is left. */
    const std::array<Reader, 7> readers = {
      {{MapFormat::npy,
        ".npy",
        [](const Evidence &e) { return e.starts_with(npy_magic); },
        [](const MapSource &source) { return read_npy(source.file); }},
       {MapFormat::netcdf,
        "NetCDF",
        [](const Evidence &e) {
          return e.starts_with("CDF") ||
                 (e.starts_with(hdf5_magic) && is_netcdf4(e.file));
        },
        read_netcdf},
       {MapFormat::hdf5,
        "HDF5",
        [](const Evidence &e) { return e.starts_with(hdf5_magic); },
        read_hdf5},
       {MapFormat::x3p,
        "X3P",
        [](const Evidence &e) { return e.starts_with(zip_magic); },
        [](const MapSource &source) { return read_x3p(source.file); }},
       {MapFormat::sdf,
        "SDF",
        [](const Evidence &e) { return is_sdf(e.start); },
        [](const MapSource &source) { return read_sdf(source.file); }},
       {MapFormat::xyz,
        "XYZ text",
        [](const Evidence &e) { return e.extension == ".xyz"; },
        [](const MapSource &source) { return read_xyz_text(source.file); }},
       {MapFormat::text,
        "matrix text",
        [](const Evidence &e) { return e.start.find('\0') == std::string::npos; },
        [](const MapSource &source) { return read_matrix_text(source.file); }}}};

    Evidence
    examine(const std::string &file)
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

      std::string extension = std::filesystem::path(file).extension().string();
      std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
      return {start, extension, file};
    }

    const Reader &
    choose_reader(const MapSource &source, const Evidence &evidence)
    {
      for (const Reader &reader : readers)
        if (source.format == MapFormat::by_content ? reader.recognises(evidence)
                                                   : reader.format == source.format)
          return reader;
      reject_height_map(source.file,
                        "has a format that is not known: export it as NetCDF, HDF5, "
                        "X3P, SDF, .npy or text.");
    }

    HeightMap
    choose_and_read(const MapSource &source, const Evidence &evidence)
    {
      const Reader &reader = choose_reader(source, evidence);
      HeightMap     map    = reader.read(source);
      map.format           = reader.name;
      return map;
    }

    /** The library that reads the file and does not withstand damage; or none. */
    std::string
    fragile_library(const MapSource &source, const Evidence &evidence)
    {
      const bool by_content = source.format == MapFormat::by_content;
      if (by_content ? evidence.starts_with("CDF") : source.format == MapFormat::netcdf)
        return "NetCDF";
      if (by_content ? evidence.starts_with(hdf5_magic)
                     : source.format == MapFormat::hdf5)
        return "HDF5";
      return {};
    }

    void
    check_values(const HeightMap &map, const std::string &file)
    {
      for (std::size_t i = 0; i < map.values.size(); ++i)
        if (std::isinf(map.values[i]))
          reject_height_map(file,
                            "has an infinite value in row " + std::to_string(i / map.nx) +
                              ", column " + std::to_string(i % map.nx) +
                              " (counted from 0): mark missing points as nan.");
      if (map.n_missing() == map.values.size())
        reject_height_map(file, "has no valid point at all: check what was exported.");
    }

    void
    check_size(const HeightMap &map, const std::string &file)
    {
      if (map.size)
        for (const double side : *map.size)
          if (!(side > 0.) || !std::isfinite(side))
            reject_height_map(file,
                              "states a size that is not positive: mend its header or "
                              "export it again.");
    }
  } // namespace

  HeightMap
  read_height_map(const MapSource &source)
  {
    if (source.file.empty())
      throw InputError(
        "Surface/File is empty: name a height map, or choose another "
        "Surface/Kind.");
    const Evidence evidence = examine(source.file);
    if (evidence.start.empty())
      reject_height_map(source.file, "is empty: copy or export it again.");
    const std::string library = fragile_library(source, evidence);
    const auto        read    = [&]() { return choose_and_read(source, evidence); };
    HeightMap         map =
      library.empty() ? read() : read_isolated({source.file, library}, read);
    check_values(map, source.file);
    check_size(map, source.file);
    return map;
  }
} // namespace strait
