// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_parameter_values_h
#define strait_base_parameter_values_h

#include <strait/base/text.h>

#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace strait
{
  // The values that a parameter of the scene may take. Each of these classes writes a
  // value with text(), reads it with read(), which gives false for what is not allowed,
  // and says in words() what is.

  /** Numbers between two limits, at first all that are 0 or of a magnitude from 1e-30 to
   *  1e30, which covers all that is measured in any units. */
  struct Range
  {
    double lower      = -std::numeric_limits<double>::infinity();
    bool   with_lower = false;
    double upper      = std::numeric_limits<double>::infinity();
    bool   with_upper = false;

    /** These numbers from @p limit on. */
    constexpr Range
    at_least(const double limit) const
    {
      return {limit, true, upper, with_upper};
    }

    /** Those that exceed @p limit. */
    constexpr Range
    above(const double limit) const
    {
      return {limit, false, upper, with_upper};
    }

    /** Those up to @p limit. */
    constexpr Range
    at_most(const double limit) const
    {
      return {lower, with_lower, limit, true};
    }

    /** Those that fall short of @p limit. */
    constexpr Range
    below(const double limit) const
    {
      return {lower, with_lower, limit, false};
    }

    /** A number as a scene has it. */
    template <typename Number>
    std::string
    text(const Number number) const
    {
      if constexpr (std::is_integral<Number>::value)
        return std::to_string(number);
      else
        return to_text(number);
    }

    /** Into an integer only an integer: 1e3 is none. */
    template <typename Number>
    bool
    read(const std::string &text, Number &number) const
    {
      double value = 0.;
      if (!read_number(text, std::is_integral<Number>::value, value))
        return false;
      number = static_cast<Number>(value);
      return true;
    }

    /** "a number above 0 and at most 1" and the like. */
    template <typename Number>
    std::string
    words(const Number &, const bool is_list) const
    {
      return words_for(std::is_integral<Number>::value, is_list);
    }

  private:
    bool read_number(const std::string &text, bool is_integer, double &number) const;
    std::string words_for(bool is_integer, bool is_list) const;
  };

  /** What to add to the words for a Range, if one of these numbers, separated by commas,
   *  is beyond all of them. */
  std::string magnitude_note(const std::string &values);

  /** All numbers. */
  inline constexpr Range any_number{};
  /** Those above 0. */
  inline constexpr Range positive = any_number.above(0.);
  /** Those from 0 on. */
  inline constexpr Range not_negative = any_number.at_least(0.);

  /** Values that have names, such as those of an enumeration. */
  template <typename Value>
  class Names
  {
  public:
    Names(std::vector<std::pair<Value, std::string>> table)
      : table(std::move(table))
    {
    }

    /** The name of @p value, which must be in the table. */
    std::string
    text(const Value &value) const
    {
      for (const auto &row : table)
        if (row.first == value)
          return row.second;
      return {};
    }

    /** Find the value called @p text; false if there is none. */
    bool
    read(const std::string &text, Value &value) const
    {
      for (const auto &row : table)
        if (row.second == text)
          {
            value = row.first;
            return true;
          }
      return false;
    }

    /** "one of: NAME, NAME". */
    std::string
    words(const Value &, const bool is_list) const
    {
      std::string words = is_list ? "some of: " : "one of: ";
      for (const auto &row : table)
        words += (&row == &table.front() ? "" : ", ") + row.second;
      return words;
    }

  private:
    std::vector<std::pair<Value, std::string>> table;
  };

  /** A text with a meaning. */
  struct Text
  {
    std::string                              meaning; // in words
    std::function<bool(const std::string &)> is_allowed;

    /** The text itself, as it is read and written. */
    std::string
    text(const std::string &value) const
    {
      return value;
    }

    /** Take @p text; false if it is not allowed. */
    bool
    read(const std::string &text, std::string &value) const
    {
      value = text;
      return is_allowed(text);
    }

    /** The meaning. */
    std::string
    words(const std::string &, bool) const
    {
      return meaning;
    }
  };
} // namespace strait

#endif
