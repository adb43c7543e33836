// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/units.h>

#include <boost/endian/conversion.hpp>

#include <array>
#include <cstdint>
#include <functional>
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
    std::string         file; // from which it was read, for messages
    int                 nx = 0;
    int                 ny = 0;
    std::vector<double> values;
    /** lx, ly of nx × ny points (not of nx − 1 spacings), where the file states them. */
    std::optional<std::array<double, 2>> size;
    LengthUnit                           lateral_unit;
    LengthUnit                           height_unit;
    bool                                 is_periodic = false; // as the file states
    std::string                          format;              // for messages

    std::size_t n_missing() const;
  };

  /**
   * Read a height map in one of the formats below, recognised by the content of the file.
   * Not collective: call it on one rank. Throws InputError if the file has another
   * format, with the command that imports it; also if it cannot be read, is incomplete,
   * has a value that is infinite or above 1e30, or no valid point, or states a size that
   * is not positive.
   */
  HeightMap read_height_map(const std::string &file);

  /**
   * Read a two-dimensional numpy array (.npy of version 1, 2 or 3) of shape
   * (ny, nx): little-endian f4, f8, i2, i4 or i8, in C or Fortran order.
   * Throws InputError for any other content, or if the length of the file is
   * not what the header promises.
   */
  HeightMap read_npy(const std::string &file);

  /**
   * Read the variable "heights" of a NetCDF file in the classic format (CDF-1 or CDF-2)
   * and the layout of contact.engineering, as strait_import and write_netcdf_map() write
   * it. Heights are floating-point numbers; the dimension called x, else the last, runs
   * along x. The coordinate variables have the attributes "length", "unit" and
   * "periodic", or "length_unit", which is the unit of the heights as well if they have
   * none. The side is the "length", but n steps of the n coordinates if the length is
   * their span, or is missing and they have a unit. NaN and _FillValue mark missing
   * points. What the header claims is checked against the length of the file: where a
   * file was cut off, the NetCDF library (4.9) would silently read zeros.
   */
  HeightMap read_netcdf(const std::string &file);

  /**
   * Read a matrix of numbers, one row of the grid per line, separated by white space,
   * with decimal points and nan for missing points, below the header
   *
   *     # Width: 12.34 µm        lx
   *     # Height: 5678.9 nm      ly
   *     # Value units: m         what a value of 1 means
   *
   * as Gwyddion writes it in English; without units, numbers are in those of the scene.
   * Other lines that begin with # and have a colon are refused, except "# Channel:", as
   * they may state a unit in another language. So are those with a number or a sign of
   * equality, which may be a mark of missing points or a scale, a header line that
   * contradicts an earlier one, and anything after the last row.
   */
  HeightMap read_matrix_text(const std::string &file);

  /** Throw an InputError that reads: the height map @p file @p complaint. */
  [[noreturn]] void reject_height_map(const std::string &file,
                                      const std::string &complaint);

  /** Throw such an InputError, with the command that imports the file. */
  [[noreturn]] void reject_for_import(const std::string &file,
                                      const std::string &complaint);

  /** The number whose bytes are stored in @p order at @p bytes. */
  template <typename Number, boost::endian::order order>
  Number
  load(const char *bytes)
  {
    return boost::endian::endian_load<Number, sizeof(Number), order>(
      reinterpret_cast<const unsigned char *>(bytes));
  }

  /** How the values of a map lie in a file: row by row, or column by column. */
  struct StoredValues
  {
    std::uint64_t                       n_columns  = 0;
    std::uint64_t                       n_rows     = 0;
    bool                                by_columns = false;
    std::uint64_t                       begin     = 0; // bytes from the start of the file
    std::uint64_t                       item_size = 0; // bytes of a value
    std::function<double(const char *)> decode;        // a value from its bytes
  };

  /**
   * Read the values of a map, and nothing else of it. Throws InputError if an extent is
   * zero or too large for any grid, or if the file cannot be read or is too short. This
   * is checked before memory is allocated, because a damaged header may claim any extent.
   */
  HeightMap read_values(const std::string &file, const StoredValues &stored);
} // namespace strait
