// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_text_row_h
#define strait_surface_readers_text_row_h

#include <string>
#include <vector>

namespace strait
{
  /**
   * Takes lines of numbers apart. The first line with several numbers settles
   * what separates them: semicolons, else white space, else commas. With commas
   * the decimal sign is a point; otherwise it may be a comma as well, but the same
   * throughout. NaN stands for nan, bad, ***, -- and the like.
   */
  class TextRow
  {
  public:
    explicit TextRow(std::string file_name);

    /** Whether @p line holds numbers rather than words. */
    bool is_data(const std::string &line) const;

    /**
     * Append the numbers of @p line to @p values. Throws InputError, with the
     * line's number, for what is no number or for another separator or decimal
     * sign than before.
     */
    void append(const std::string &line, long line_number, std::vector<double> &values);

  private:
    void settle_separator(const std::string &line);
    double
    parse(const char *begin, const char *end, long line_number, std::size_t column);

    std::string file;
    char        separator    = 0; // not known yet
    char        decimal_sign = 0; // likewise
  };
} // namespace strait

#endif
