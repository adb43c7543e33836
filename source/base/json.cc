// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/json.h>

#include <boost/algorithm/string.hpp>

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
          result += format("\\u%04x", static_cast<unsigned>(letter));
        else
          result += letter;
      return result + "\"";
    }

    /** The lines of a value one level deeper; within texts there are no line ends. */
    std::string
    indented(const std::string &value)
    {
      return boost::replace_all_copy("\n" + value, "\n", "\n  ");
    }
  } // namespace

  Json::Json(const std::string &text)
    : start(quoted(text))
  {
  }

  Json
  Json::verbatim(const std::string &text)
  {
    Json json;
    json.start = text;
    return json;
  }

  Json
  Json::object()
  {
    Json json;
    json.start = "{";
    json.end   = "}";
    return json;
  }

  Json
  Json::array()
  {
    Json json;
    json.start = "[";
    json.end   = "]";
    return json;
  }

  Json &
  Json::set(const std::string &name, const Json &value)
  {
    elements.push_back(quoted(name) + ": " + value.text());
    return *this;
  }

  Json &
  Json::append(const Json &value)
  {
    elements.push_back(value.text());
    return *this;
  }

  std::string
  Json::text() const
  {
    std::string content;
    for (const std::string &element : elements)
      content += (content.empty() ? "" : ",") + indented(element);
    return start + content + (elements.empty() ? "" : "\n") + end;
  }
} // namespace strait
