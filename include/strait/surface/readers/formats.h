// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_formats_h
#define strait_surface_readers_formats_h

#include <strait/surface/readers/height_map.h>

/** The formats of height maps. Each has a source of its own; formats.cc chooses. */
namespace strait
{
  /**
   * Read a height map in one of the formats below; unless the source
   * says which, the content of the file tells, and of XYZ text the extension.
   * Not collective: call it on one rank. Throws InputError if the file cannot be
   * read, has an unknown format, is incomplete, or holds an infinite value.
   */
  HeightMap read_height_map(const MapSource &source);

  /**
   * Read a two-dimensional numpy array (.npy of version 1, 2 or 3) of shape
   * (ny, nx): little-endian f4, f8, i2, i4 or i8, in C or Fortran order.
   * Throws InputError for any other content, or if the length of the file is
   * not what the header promises.
   */
  HeightMap read_npy(const std::string &file);

  /** Whether an HDF5 file was written by the NetCDF library. */
  bool is_netcdf4(const std::string &file);

  /**
   * Read a two-dimensional variable of a NetCDF file, classic or NetCDF-4: the
   * one that source.dataset names, or "heights", or the only one. The dimension
   * called x (else the last) runs along x. Coordinate variables x and y may have
   * the attributes "length" (of the whole side), "unit" and "periodic", or else
   * give the spacing; the attribute "unit" or "units" of the heights is their
   * unit. "scale_factor", "add_offset", "_FillValue" and "missing_value" have
   * their usual meaning. This is the layout of contact.engineering.
   */
  HeightMap read_netcdf(const MapSource &source);

  /**
   * Read a two-dimensional data set of numbers of shape (ny, nx) from an HDF5
   * file: the one that source.dataset names, or the only one. Of its attributes
   * and those of the file, "unit" or "units" states the unit of the heights,
   * "lx" and "ly", or "dx" and "dy", the size, "lateral_unit" its unit and
   * "periodic" whether the map repeats itself.
   */
  HeightMap read_hdf5(const MapSource &source);

  /**
   * Read an X3P file (ISO 25178-72): a matrix with regular x and y axes, its
   * heights 16 or 32 bit integers or floating-point numbers in the archive, or a
   * list in the XML; lengths in metres. NaN, points that the list of valid points
   * excludes, and empty entries of the list are missing.
   */
  HeightMap read_x3p(const std::string &file);

  /** Whether a file that begins with @p start is a surface data file. */
  bool is_sdf(const std::string &start);

  /**
   * Read a surface data file (ISO 25178-71, and BCR-STM 1.0 before it), ASCII or
   * binary; lengths in metres. BAD, the reserved value of the integer types and
   * NaN mark missing points. Throws InputError for compressed data, an unknown
   * type, or data that are shorter than the header promises.
   */
  HeightMap read_sdf(const std::string &file);

  /**
   * Read lines of x, y, z, separated as TextRow says, in any order, below any
   * number of header lines (those of read_matrix_text() have the same meaning,
   * sizes apart). The points must lie on a regular grid, to a twentieth of its
   * spacings; grid points without a line count as missing, as do those whose z
   * is no number but two words or one, such as "No Data".
   * Throws InputError for points that form no grid, or name one twice.
   */
  HeightMap read_xyz_text(const std::string &file);

  /**
   * Read a matrix of numbers, one row of the grid a line, separated as TextRow
   * says, below any number of header lines. Blank lines and lines that start
   * with # are skipped. Header lines such as these have a meaning, in capitals
   * or not, with "quotes", # or % around them:
   *
   *     h=650 w=650                            rows and columns
   *     pixel size=3.7e-7 m                    grid spacing
   *     height conversion factor (-> m)=6e-8   what a value of 1 means
   *     # Width: 12.34 µm                      lx    (Gwyddion)
   *     # Height: 5678.9 nm                    ly    (Gwyddion)
   *     # Value units: m                       what a value of 1 means
   *     "XY calibration","276.9","nm"          grid spacing
   *     # x-pixels = 512, # x-length = 1000    columns, lx    (SPIP)
   *     # Bit2nm = 0.0105                      nanometres of a value of 1
   *
   * Throws InputError for rows of unequal length, a matrix other than the
   * header promises, a word that is not a number, or an unknown unit of length.
   */
  HeightMap read_matrix_text(const std::string &file);
} // namespace strait

#endif
