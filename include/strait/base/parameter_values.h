// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_parameter_values_h
#define strait_base_parameter_values_h

#include <strait/base/text.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  /** Whether a list has a value twice. */
  template <typename Value>
  bool
  has_repetitions(const std::vector<Value> &values)
  {
    return std::set<Value>(values.begin(), values.end()).size() != values.size();
  }

  // The values that a parameter of the scene may take. Each of these classes writes a
  // value with text(), reads it with read(), which gives false for what is not allowed,
  // and says in words() what is: of whole numbers or others, of one or of a list.

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
    std::string words(bool is_integer, bool is_list) const;

  private:
    bool read_number(const std::string &text, bool is_integer, double &number) const;
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

  /** The names of an enumeration's values, all of them and in the order of their
   *  declaration, which nothing else ties them to. */
  class Names
  {
  public:
    Names(std::initializer_list<std::string> names)
      : names(names)
    {
    }

    /** The name of @p value. */
    template <typename Value>
    std::string
    text(const Value value) const
    {
      return names.at(static_cast<std::size_t>(value));
    }

    /** Find the value called @p text; false if there is none. */
    template <typename Value>
    bool
    read(const std::string &text, Value &value) const
    {
      const auto found = std::find(names.begin(), names.end(), text);
      if (found != names.end())
        value = static_cast<Value>(found - names.begin());
      return found != names.end();
    }

    /** "one of: NAME, NAME". */
    std::string
    words(bool, const bool is_list) const
    {
      return (is_list ? "some of: " : "one of: ") + join(names, ", ");
    }

  private:
    std::vector<std::string> names;
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
    words(bool, bool) const
    {
      return meaning;
    }
  };
} // namespace strait

#endif
