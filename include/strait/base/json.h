// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_json_h
#define strait_base_json_h

#include <iosfwd>
#include <string>
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
    Json(bool value);
    Json(int value);
    Json(unsigned int value);
    Json(long value);
    Json(unsigned long value);
    Json(long long value);
    Json(unsigned long long value);
    Json(double value);
    Json(const char *value);
    Json(const std::string &value);

    template <typename Value>
    Json(const std::vector<Value> &values)
      : kind(Kind::array)
    {
      for (const Value &value : values)
        elements.emplace_back(value);
    }

    /** A value that is JSON text already. */
    static Json verbatim(const std::string &text);
    static Json object();
    static Json array();

    /** Set a member of an object; setting it again replaces it. */
    Json &set(const std::string &name, Json value);

    /** Append to an array. */
    Json &append(Json value);

    /** Indented by two blanks a level. */
    std::string text() const;

  private:
    enum class Kind
    {
      scalar,
      array,
      object
    };

    void write(std::ostream &out, const std::string &indent) const;

    Kind                     kind   = Kind::scalar;
    std::string              scalar = "null"; // as it is written
    std::vector<std::string> names;           // of an object's elements
    std::vector<Json>        elements;
  };
} // namespace strait

#endif
