// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_height_map_h
#define strait_surface_readers_height_map_h

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** Heights of nx × ny points as a file holds them, row by row, x fastest. */
  struct HeightMap
  {
    int                 nx = 0;
    int                 ny = 0;
    std::vector<double> values;
    /** lx, ly in metres, where the file states them. */
    std::optional<std::array<double, 2>> size;
  };

  /**
   * Read a height map in one of the formats of this folder; the content of the
   * file, not its name, tells which. Not collective: call it on one rank.
   * Throws InputError if the file cannot be read, has an unknown format, is
   * incomplete, or holds a value that is not finite.
   */
  HeightMap read_height_map(const std::string &file);

  /** Throw InputError: the height map @p file @p complaint. */
  [[noreturn]] void reject_height_map(const std::string &file,
                                      const std::string &complaint);
} // namespace strait

#endif
