// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_matrix_text_h
#define strait_surface_readers_matrix_text_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
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
