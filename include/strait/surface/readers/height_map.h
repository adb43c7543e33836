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
    std::string         file; // that it was read from, for messages
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

  /**
   * Read a height map in one of the formats below; the content of the file tells which.
   * Not collective: call it on one rank. Throws InputError, with the command that imports
   * the file, if it is of any other kind; also if it cannot be read, is incomplete, or
   * holds an infinite value.
   */
  HeightMap read_height_map(const std::string &file);

  /**
   * Read a two-dimensional numpy array (.npy of version 1, 2 or 3) of shape
   * (ny, nx): little-endian f4, f8, i2, i4 or i8, in C or Fortran order.
   * Throws InputError for any other content, or if the length of the file is
   * not what the header promises.
   */
  HeightMap read_npy(const std::string &file);

  /** What the classic format of NetCDF calls its types of numbers. */
  enum NetcdfType : std::uint64_t
  {
    type_byte   = 1,
    type_char   = 2,
    type_short  = 3,
    type_int    = 4,
    type_float  = 5,
    type_double = 6
  };

  /**
   * Read the variable "heights" of a NetCDF file in the classic format (CDF-1 or CDF-2)
   * and the layout of contact.engineering, as strait_import and write_netcdf_map() leave
   * it: floating-point numbers; the dimension called x, else the last, runs along x;
   * coordinate variables with the attributes "length" (of the whole side; without it, or
   * where it is the span of the coordinates, n of their steps), "unit" and "periodic", or
   * "length_unit", which is that of the heights as well if they have none.
   * NaN and _FillValue mark missing points. What the header claims is checked against the
   * length of the file: the library of NetCDF (4.9) would read zeros where a file was cut
   * off, without a word.
   */
  HeightMap read_netcdf(const std::string &file);

  /**
   * Read a matrix of numbers, one row of the grid a line, separated by white space with
   * decimal points, nan for missing points, below
   *
   *     # Width: 12.34 µm        lx
   *     # Height: 5678.9 nm      ly
   *     # Value units: m         what a value of 1 means
   *
   * as Gwyddion writes it in English, or without units in those of the scene. Other lines
   * that begin with # and have a colon are refused, but for "# Channel:": they may state
   * a unit in another language. So is whatever follows the last row, and a line that
   * contradicts an earlier one.
   */
  HeightMap read_matrix_text(const std::string &file);

  /** Throw InputError: the height map @p file @p complaint. */
  [[noreturn]] void reject_height_map(const std::string &file,
                                      const std::string &complaint);

  /** Throw InputError: the height map @p file @p complaint; and what imports it. */
  [[noreturn]] void reject_for_import(const std::string &file,
                                      const std::string &complaint);

  /** The number whose bytes, in @p order, are at @p bytes. */
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
   * Read the values of a map, and nothing else of it. Throws InputError if they cannot
   * be: an extent is zero or too large for any grid, or the file is too short, which is
   * checked before memory is set aside for what a damaged header may claim.
   */
  HeightMap read_values(const std::string &file, const StoredValues &stored);
} // namespace strait
