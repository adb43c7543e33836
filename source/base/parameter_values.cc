// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/parameter_values.h>
#include <strait/base/text.h>

#include <cmath>
#include <sstream>

namespace strait
{
  namespace
  {
    /** Whether @p text is a number of the type of @p number and nothing else; not one
     * that is too small for it. */
    template <typename Number>
    bool
    is_number(const std::string &text, Number &number)
    {
      std::istringstream in(text);
      in >> number;
      const bool vanishes =
        number == 0 &&
        text.substr(0, text.find_first_of("eE")).find_first_of("123456789") !=
          std::string::npos;
      return in && in.peek() == std::istringstream::traits_type::eof() && !vanishes;
    }

    // Numbers other than 0 are no further from 1 than this: a conductivity g³/12η and the
    // squares of what follows from it are then still far from the limits of a double. In
    // any consistent units seals are within 1e±20; with 1e±60 these squares vanish.
    constexpr double largest_magnitude = 1e30;

    bool
    has_usable_magnitude(const double number)
    {
      const double magnitude = std::abs(number);
      return number == 0. ||
             (magnitude <= largest_magnitude && magnitude >= 1. / largest_magnitude);
    }
  } // namespace

  bool
  Range::read_number(const std::string &text, const bool is_integer, double &number) const
  {
    int        integer = 0;
    const bool is_one  = is_integer ? is_number(text, integer) : is_number(text, number);
    if (is_integer)
      number = integer;
    return is_one && (is_integer || has_usable_magnitude(number)) &&
           (with_lower ? number >= lower : number > lower) &&
           (with_upper ? number <= upper : number < upper);
  }

  std::string
  magnitude_note(const std::string &values)
  {
    for (const std::string &part : split(values, ','))
      if (double number = 0.; is_number(part, number) && !has_usable_magnitude(number))
        return ", 0 or of a magnitude from 1e-30 to 1e30";
    return "";
  }

  std::string
  Range::words(const bool is_integer, const bool is_list) const
  {
    std::string words     = is_list ? (is_integer ? "integers" : "numbers")
                                    : (is_integer ? "an integer" : "a number");
    const bool  has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
    if (has_lower && has_upper && with_lower && with_upper)
      words += " from " + text(lower) + " to " + text(upper);
    else
      {
        if (has_lower)
          words += (with_lower ? " of at least " : " above ") + text(lower);
        if (has_upper)
          words += (has_lower    ? " and"
                    : with_upper ? " of"
                                 : "") +
                   std::string(with_upper ? " at most " : " below ") + text(upper);
      }
    return words + (is_list ? ", separated by commas" : "");
  }
} // namespace strait
