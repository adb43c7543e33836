// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/parameter_values.h>
#include <strait/base/text.h>

#include <cmath>
#include <sstream>

namespace strait
{
  namespace
  {
    /** Whether @p text is a number of the type of @p number and nothing else. */
    template <typename Number>
    bool
    is_number(const std::string &text, Number &number)
    {
      std::istringstream in(text);
      in >> number;
      return in && in.peek() == std::istringstream::traits_type::eof();
    }
  } // namespace

  bool
  Range::read_number(const std::string &text, const bool is_integer, double &number) const
  {
    int        integer = 0;
    const bool is_one  = is_integer ? is_number(text, integer) : is_number(text, number);
    if (is_integer)
      number = integer;
    return is_one && (with_lower ? number >= lower : number > lower) &&
           (with_upper ? number <= upper : number < upper);
  }

  std::string
  Range::words_for(const bool is_integer, const bool is_list) const
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
