// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/json.h>
#include <strait/base/text.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace strait
{
  namespace
  {
    std::string
    quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char letter : text)
        if (letter == '"' || letter == '\\')
          result += std::string("\\") + letter;
        else if (letter == '\n')
          result += "\\n";
        else if (letter == '\t')
          result += "\\t";
        else if (static_cast<unsigned char>(letter) < 0x20)
          {
            char code[8];
            std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned>(letter));
            result += code;
          }
        else
          result += letter;
      return result + "\"";
    }
  } // namespace

  Json::Json(const bool value)
    : scalar(value ? "true" : "false")
  {
  }

  Json::Json(const int value)
    : scalar(std::to_string(value))
  {
  }

  Json::Json(const unsigned int value)
    : scalar(std::to_string(value))
  {
  }

  Json::Json(const long value)
    : scalar(std::to_string(value))
  {
  }

  Json::Json(const unsigned long value)
    : scalar(std::to_string(value))
  {
  }

  Json::Json(const long long value)
    : scalar(std::to_string(value))
  {
  }

  Json::Json(const unsigned long long value)
    : scalar(std::to_string(value))
  {
  }

  Json::Json(const double value)
    : scalar(std::isfinite(value) ? to_text(value) : "null")
  {
  }

  Json::Json(const char *value)
    : scalar(quoted(value))
  {
  }

  Json::Json(const std::string &value)
    : scalar(quoted(value))
  {
  }

  Json
  Json::verbatim(const std::string &text)
  {
    Json json;
    json.scalar = text;
    return json;
  }

  Json
  Json::object()
  {
    Json json;
    json.kind = Kind::object;
    return json;
  }

  Json
  Json::array()
  {
    Json json;
    json.kind = Kind::array;
    return json;
  }

  Json &
  Json::set(const std::string &name, Json value)
  {
    const auto known = std::find(names.begin(), names.end(), name);
    if (known != names.end())
      elements[known - names.begin()] = std::move(value);
    else
      {
        names.push_back(name);
        elements.push_back(std::move(value));
      }
    return *this;
  }

  Json &
  Json::append(Json value)
  {
    elements.push_back(std::move(value));
    return *this;
  }

  std::string
  Json::text() const
  {
    std::ostringstream out;
    write(out, "");
    return out.str();
  }

  void
  Json::write(std::ostream &out, const std::string &indent) const
  {
    if (kind == Kind::scalar)
      {
        out << scalar;
        return;
      }
    const bool is_object = kind == Kind::object;
    out << (is_object ? "{" : "[");
    for (std::size_t i = 0; i < elements.size(); ++i)
      {
        out << (i > 0 ? "," : "") << "\n" << indent << "  ";
        if (is_object)
          out << quoted(names[i]) << ": ";
        elements[i].write(out, indent + "  ");
      }
    if (!elements.empty())
      out << "\n" << indent;
    out << (is_object ? "}" : "]");
  }
} // namespace strait
