// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_json_h
#define strait_base_json_h

#include <strait/base/text.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  /**
   * A JSON value to be written: a text, number, truth value, array or object.
   * Objects keep the order in which their members were set. Numbers are written
   * such that they read back exactly; those that are not finite become null,
   * because JSON has no word for them.
   */
  class Json
  {
  public:
    Json() = default; // null
    Json(const std::string &text);
    Json(const char *text)
      : Json(std::string(text))
    {
    }

    template <typename Number,
              typename = std::enable_if_t<std::is_arithmetic<Number>::value>>
    Json(const Number number)
    {
      if constexpr (std::is_same<Number, bool>::value)
        start = number ? "true" : "false";
      else if constexpr (std::is_integral<Number>::value)
        start = std::to_string(number);
      else if (std::isfinite(number))
        start = to_text(number);
    }

    template <typename Value>
    Json(const std::vector<Value> &values)
      : Json(array())
    {
      for (const Value &value : values)
        append(value);
    }

    /** A value that is JSON text already. */
    static Json verbatim(const std::string &text);
    static Json object();
    static Json array();

    /** Add a member to an object. */
    Json &set(const std::string &name, const Json &value);

    /** Append to an array. */
    Json &append(const Json &value);

    /** Indented by two blanks a level. */
    std::string text() const;

  private:
    std::string              start = "null"; // all of a scalar
    std::string              end;            // of arrays and objects
    std::vector<std::string> elements;
  };
} // namespace strait

#endif
