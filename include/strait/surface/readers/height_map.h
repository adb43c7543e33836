// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_height_map_h
#define strait_surface_readers_height_map_h

#include <strait/base/surface_parameters.h>
#include <strait/base/units.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /**
   * Heights of nx × ny points as a file holds them, row by row, x fastest; in
   * the file's own units, NaN where nothing was measured.
   */
  struct HeightMap
  {
    int                 nx = 0;
    int                 ny = 0;
    std::vector<double> values;
    /** lx, ly of nx × ny points (not of nx − 1 spacings), where the file states them. */
    std::optional<std::array<double, 2>> size;
    LengthUnit                           lateral_unit;
    LengthUnit                           height_unit;
    bool                                 is_periodic = false; // says the file
    std::string                          format;              // for messages

    std::size_t n_missing() const;
  };

  /** What is to be read, and how. */
  struct MapSource
  {
    std::string file;
    MapFormat   format  = MapFormat::by_content;
    std::string dataset = {}; // HDF5 and NetCDF; empty: the only one that fits
  };

  /** Throw InputError: the height map @p file @p complaint. */
  [[noreturn]] void reject_height_map(const std::string &file,
                                      const std::string &complaint);

  /**
   * Throw InputError if a map of n_columns × n_rows values of @p item_size bytes
   * cannot be: an extent is zero or too large for any grid, or there are fewer
   * than that many bytes in @p n_bytes. Call it before memory is set aside for
   * what a damaged header may claim.
   */
  void check_claim(const std::string &file,
                   std::uint64_t      n_columns,
                   std::uint64_t      n_rows,
                   std::uint64_t      item_size,
                   std::uint64_t      n_bytes);

  /** What deflate can at most make of a byte: the bound for compressed data. */
  inline constexpr std::uint64_t largest_compression = 1032;
} // namespace strait

#endif
