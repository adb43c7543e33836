// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_matrix_text_h
#define strait_surface_readers_matrix_text_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /**
   * Read a matrix of numbers, one row of the grid a line, separated by white
   * space, commas or semicolons (one of them throughout the file), below any
   * number of header lines. Blank lines and lines that start with # are
   * skipped. These header lines have a meaning, in capitals or not:
   *
   *     h=650 w=650                            rows and columns
   *     pixel size=3.7e-7 m                    grid spacing
   *     height conversion factor (-> m)=6e-8   what a value of 1 means
   *     # Width: 12.34 µm                      lx    (Gwyddion)
   *     # Height: 5678.9 nm                    ly    (Gwyddion)
   *     # Value units: m                       what a value of 1 means
   *
   * Stated lengths and heights become metres; µ may be UTF-8 or Latin-1.
   * Throws InputError for rows of unequal length, a matrix other than the
   * header promises, a word that is not a number, or an unknown unit.
   */
  HeightMap read_matrix_text(const std::string &file);
} // namespace strait

#endif
