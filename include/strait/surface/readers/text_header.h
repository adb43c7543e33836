// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_text_header_h
#define strait_surface_readers_text_header_h

#include <array>
#include <optional>
#include <string>

namespace strait
{
  /** What the header lines of a matrix text say; lengths in metres. */
  struct TextHeader
  {
    std::optional<int>    n_rows;
    std::optional<int>    n_columns;
    std::optional<double> pixel_size;
    std::optional<double> width;           // lx
    std::optional<double> height;          // ly
    double                value_unit = 1.; // what a value of 1 in the matrix means

    /**
     * Take over what @p line states; a line without meaning is passed over.
     * Throws InputError, which names @p file, for a length that is not one.
     */
    void parse_line(const std::string &line, const std::string &file);

    /** The box of a matrix of nx × ny values, if the header states it. */
    std::optional<std::array<double, 2>> size(int nx, int ny) const;
  };

  /**
   * The number at @p position, which moves behind it; nothing if there is none.
   * Unlike std::stod this knows no locale: the decimal sign is a point.
   */
  std::optional<double> read_number(const char *&position, const char *end);
} // namespace strait

#endif
