// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_text_header_h
#define strait_surface_readers_text_header_h

#include <strait/surface/readers/height_map.h>

#include <array>
#include <optional>
#include <string>

namespace strait
{
  /** What the header lines of a text file say. */
  class TextHeader
  {
  public:
    explicit TextHeader(std::string file_name);

    /**
     * Take over what @p line states; a line without meaning is passed over.
     * Throws InputError for a length that is not one.
     */
    void parse_line(const std::string &line);

    /** Give @p map, whose nx and ny are set, size and units as far as stated. */
    void complete(HeightMap &map) const;

    /** The unit of coordinates, "xy unit: um", if it is stated. */
    const LengthUnit &
    lateral_unit() const
    {
      return coordinate_unit;
    }

    std::optional<int> n_rows;
    std::optional<int> n_columns;

  private:
    /** A length in metres, or without a unit. */
    struct Length
    {
      double value    = 0.;
      bool   has_unit = false;
    };

    Length parse_length(const std::string &number, const std::string &unit) const;
    bool   parse_lateral(const std::string &key,
                         const std::string &number,
                         const std::string &unit);

    std::string                          file;
    std::array<std::optional<Length>, 2> sides;
    std::array<std::optional<Length>, 2> spacings;
    LengthUnit                           value_unit;
    LengthUnit                           coordinate_unit;
    bool                                 has_factor = false;
  };

  /**
   * The number at @p position, which moves behind it; nothing if there is none.
   * Unlike std::stod this knows no locale: the decimal sign is a point.
   */
  std::optional<double> read_number(const char *&position, const char *end);
} // namespace strait

#endif
