// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene_text.h>
#include <strait/base/text.h>

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  /** Whether a list contains a value twice. */
  template <typename Value>
  bool
  has_repetitions(const std::vector<Value> &values)
  {
    return std::set<Value>(values.begin(), values.end()).size() != values.size();
  }

  /** Numbers other than 0 lie between this and its reciprocal: a conductivity g³/12η and
   *  the squares of what follows from it are then far from the limits of a double. Seals
   *  are within 1e±20 in any consistent units; with 1e±60 these squares underflow. */
  inline constexpr double largest_magnitude = 1e30;

  /** Whether @p number is 0 or has such a magnitude; false for what is not finite. */
  bool has_usable_magnitude(double number);

  // The values that a parameter of the scene may take. Each of these classes writes a
  // value with text(), reads it with read(), which returns false for a value that is not
  // allowed, and describes in words() what is: for integers or not, for a list or not.

  /** Numbers between two limits, if any. All but integers must also be 0 or of a
   *  magnitude from 1e-30 to 1e30, which covers all that is measured in any units. */
  struct Range
  {
    double lower      = -std::numeric_limits<double>::infinity();
    bool   with_lower = false;
    double upper      = std::numeric_limits<double>::infinity();
    bool   with_upper = false;

    /** The same range with the lower limit @p limit, which is included. */
    constexpr Range
    at_least(const double limit) const
    {
      return {limit, true, upper, with_upper};
    }

    /** The same range with the lower limit @p limit, which is excluded. */
    constexpr Range
    above(const double limit) const
    {
      return {limit, false, upper, with_upper};
    }

    /** The same range with the upper limit @p limit, which is included. */
    constexpr Range
    at_most(const double limit) const
    {
      return {lower, with_lower, limit, true};
    }

    /** The same range with the upper limit @p limit, which is excluded. */
    constexpr Range
    below(const double limit) const
    {
      return {lower, with_lower, limit, false};
    }

    /** A number as it is written in a scene. */
    template <typename Number>
    std::string
    text(const Number number) const
    {
      if constexpr (std::is_integral<Number>::value)
        return std::to_string(number);
      else
        return to_text(number);
    }

    /** Read a number; false if it is not allowed. 1e3 is not read as an integer. */
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

    /** The values allowed, such as "a number above 0 and at most 1". */
    std::string words(bool is_integer, bool is_list) const;

  private:
    bool read_number(const std::string &text, bool is_integer, double &number) const;
  };

  /** The addition to the words of a Range if one of these numbers, separated by commas,
   *  has a magnitude that no Range allows; else empty. */
  std::string magnitude_note(const std::string &values);

  /** All numbers of a usable magnitude. */
  inline constexpr Range any_number{};
  /** Numbers above 0. */
  inline constexpr Range positive = any_number.above(0.);
  /** Numbers of at least 0. */
  inline constexpr Range not_negative = any_number.at_least(0.);

  /** The names of all values of an enumeration. They must be in the order of its
   *  declaration, which is not checked. */
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

    /** "one of: NAME, NAME"; for a list "some of: ...". */
    std::string
    words(bool, const bool is_list) const
    {
      return (is_list ? "some of: " : "one of: ") + join(names, ", ");
    }

  private:
    std::vector<std::string> names;
  };

  /** The texts that a function allows. */
  struct Text
  {
    std::string                              meaning; // of those allowed, in words
    std::function<bool(const std::string &)> is_allowed;

    /** The text itself. */
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

  /** A parameter of the scene: its value and documentation, and where the value goes. */
  struct Parameter
  {
    std::string section; // "Section/Subsection"
    std::string name;
    std::string value;   // initially the default
    std::string allowed; // the values allowed, in words

    /** Read the value from a text into its variable; false if it is not allowed. */
    std::function<bool(const std::string &)> take;

    bool        is_path = false;
    std::string keyword = {}; // allowed in place of a path
    std::string meaning = {}; // with the unit in brackets

    std::vector<std::string> conditions = {}; // all must hold for an effect, see when()
    std::string              default_value = {}; // the default
  };

  /** All parameters of a scene, in the order of the documentation. */
  class ParameterTable
  {
  public:
    /** Append a parameter; those of a section must be contiguous. The next call
     *  invalidates the reference that is returned. */
    Parameter &
    add(Parameter parameter)
    {
      parameter.default_value = parameter.value;
      return parameters.emplace_back(std::move(parameter));
    }

    /** Give a parameter the value of @p entry; a relative path starts at the folder of
     *  the entry. Throws InputError, with the place of the entry, for a section or
     *  parameter that does not exist (with the nearest name that does) and for a value
     *  that is not allowed. */
    void assign(const SceneEntry &entry);

    /** One sentence for each condition that does not hold, if parameters that need it
     *  have other values than their defaults. */
    std::vector<std::string> without_effect() const;

    /** A scene file with all values, documented by comments if @p explained. */
    std::string scene(bool explained) const;

    /** A page of Markdown with a table for each section. */
    std::string markdown() const;

  private:
    Parameter &find(const SceneEntry &entry);
    bool       holds(const std::string &condition) const;

    std::vector<Parameter> parameters;
  };

  /** One section of the table. Each add() appends a parameter, given its name, the
   *  variable that holds the default and receives the value, and the values allowed. The
   *  variable must not move while the table is in use. The caller sets the meaning. */
  struct ParameterSection
  {
    ParameterTable          &table;
    std::string              path;
    std::vector<std::string> conditions = {};

    /** A section within this one, without its conditions. */
    ParameterSection
    subsection(const std::string &name) const
    {
      return {table, path + "/" + name};
    }

    /** The same section for parameters that have an effect only if @p condition holds as
     *  well. "Kind = sine, file" holds if Kind in this section has one of these values,
     *  "Seeds" if it differs from its default. Alternatives are separated by " | ";
     *  parameters of other sections are given by their path, as Theory/Enabled. */
    ParameterSection when(const std::string &condition) const;

    /** A parameter that is true or false. */
    [[nodiscard]] Parameter &add(const std::string &name, bool &variable);

    /** The path of a file; @p keyword is allowed in its place. */
    [[nodiscard]] Parameter &add_path(const std::string &name,
                                      std::string       &variable,
                                      const std::string &keyword = {});

    /** A single value; @p values is a Range, Names or a Text. */
    template <typename Value, typename Values>
    [[nodiscard]] Parameter &
    add(const std::string &name, Value &variable, const Values &values)
    {
      return append({path,
                     name,
                     values.text(variable),
                     values.words(std::is_integral<Value>::value, false),
                     [&variable, values](const std::string &text) {
                       return values.read(text, variable);
                     }});
    }

    /** A list, which may be empty. */
    template <typename Value, typename Values>
    [[nodiscard]] Parameter &
    add(const std::string &name, std::vector<Value> &variable, const Values &values)
    {
      std::vector<std::string> texts;
      texts.reserve(variable.size());
      for (const Value &value : variable)
        texts.push_back(values.text(value));
      return append({path,
                     name,
                     join(texts, ", "),
                     values.words(std::is_integral<Value>::value, true),
                     [&variable, values](const std::string &text) {
                       return read_list(text, values, variable);
                     }});
    }

    /** One value for each direction; if they are the same, one stands for both. */
    template <typename Value, typename Values>
    [[nodiscard]] Parameter &
    add(const std::string &name, std::array<Value, 2> &variable, const Values &values)
    {
      const std::string first = values.text(variable[0]);
      return append(
        {path,
         name,
         variable[0] == variable[1] ? first : first + ", " + values.text(variable[1]),
         "one or two " + values.words(std::is_integral<Value>::value, true),
         [&variable, values](const std::string &text) {
           std::vector<Value> list;
           if (!read_list(text, values, list) || list.empty() || list.size() > 2)
             return false;
           variable = {{list.front(), list.back()}};
           return true;
         }});
    }

  private:
    template <typename Value, typename Values>
    static bool
    read_list(const std::string &text, const Values &values, std::vector<Value> &list)
    {
      std::vector<std::string> parts = split(text, ',');
      if (parts.back().empty()) // an empty list, or a comma at its end
        parts.pop_back();
      list.assign(parts.size(), Value());
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (!values.read(parts[i], list[i]))
          return false;
      return true;
    }

    Parameter &append(Parameter parameter);
  };
} // namespace strait
