// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace strait
{
  namespace
  {
    /** Read @p number from @p text. Return whether the text is a number of that type and
     *  nothing else; false also for one that underflows to 0. */
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

    const char *const see_list = "; 'strait --parameters' lists all names.";
  } // namespace

  bool
  has_usable_magnitude(const double number)
  {
    const double magnitude = std::abs(number);
    return number == 0. ||
           (magnitude <= largest_magnitude && magnitude >= 1. / largest_magnitude);
  }

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

  Parameter &
  ParameterTable::find(const SceneEntry &entry)
  {
    // A name with a slash was written as --set takes it: compare it with whole paths.
    const bool is_whole = entry.name.find('/') != std::string::npos;
    const auto called   = [&](const Parameter &parameter) {
      return (is_whole ? parameter.section + "/" : "") + parameter.name;
    };
    std::vector<std::string> siblings, names;
    for (Parameter &parameter : parameters)
      {
        names.push_back(called(parameter));
        if (parameter.section != entry.section)
          continue;
        if (parameter.name == entry.name)
          return parameter;
        siblings.push_back(parameter.name);
      }
    std::string       nearest   = nearest_name(entry.name, siblings);
    const std::string elsewhere = nearest_name(entry.name, names);
    for (const Parameter &parameter : parameters)
      if (nearest.empty() && called(parameter) == elsewhere)
        nearest = is_whole
                    ? "set " + parameter.name + "' in 'subsection " + parameter.section
                    : parameter.section + "/" + parameter.name;
    throw InputError(entry.place + ": unknown parameter '" + entry.name + "' " +
                     (entry.section.empty() ? "outside every subsection"
                                            : "in subsection '" + entry.section + "'") +
                     suggestion(nearest, see_list));
  }

  void
  ParameterTable::assign(const SceneEntry &entry)
  {
    std::vector<std::string> sections;
    for (const Parameter &parameter : parameters)
      sections.push_back(parameter.section);
    if (!entry.section.empty() &&
        std::find(sections.begin(), sections.end(), entry.section) == sections.end())
      throw InputError(entry.place + ": unknown subsection '" + entry.section + "'" +
                       suggestion(nearest_name(entry.section, sections), see_list));
    if (entry.name.empty())
      return;
    Parameter &parameter = find(entry);
    parameter.value      = entry.value;
    if (parameter.is_path && !entry.value.empty() && entry.value != parameter.keyword)
      parameter.value =
        (std::filesystem::path(entry.folder) / entry.value).lexically_normal().string();
    // The scene that a run leaves behind must repeat it.
    if (const std::string &value = parameter.value;
        value.find('#') != std::string::npos || (!value.empty() && value.back() == '\\'))
      throw InputError(entry.place + ": " + parameter.section + "/" + parameter.name +
                       " = '" + value +
                       "' has a # or ends with a backslash, which a scene file cannot "
                       "state; rename the file or folder.");
    if (!parameter.take(parameter.value))
      throw InputError(entry.place + ": '" + entry.value + "' is no value for " +
                       parameter.section + "/" + parameter.name + "; expected " +
                       parameter.allowed + magnitude_note(entry.value) + ".");
  }

  bool
  ParameterTable::holds(const std::string &condition) const
  {
    for (const std::string &alternative : split(condition, '|'))
      {
        const std::vector<std::string> sides = split(alternative, '=');
        const auto                     decider =
          std::find_if(parameters.begin(),
                       parameters.end(),
                       [&](const Parameter &parameter) {
                         return parameter.section + "/" + parameter.name == sides.front();
                       });
        if (decider == parameters.end())
          throw std::logic_error("No parameter " + sides.front() + " to depend on.");
        const auto values = split(sides.back(), ',');
        if (sides.size() == 1
              ? decider->value != decider->default_value
              : std::find(values.begin(), values.end(), decider->value) != values.end())
          return true;
      }
    return false;
  }

  std::vector<std::string>
  ParameterTable::without_effect() const
  {
    std::vector<std::pair<std::string, std::vector<std::string>>> idle; // by condition
    for (const Parameter &parameter : parameters)
      {
        const auto &conditions = parameter.conditions;
        const auto  missed =
          std::find_if_not(conditions.begin(),
                           conditions.end(),
                           [this](const std::string &each) { return holds(each); });
        if (missed == conditions.end() || parameter.value == parameter.default_value)
          continue;
        auto with = std::find_if(idle.begin(), idle.end(), [&](const auto &group) {
          return group.first == *missed;
        });
        if (with == idle.end())
          with = idle.insert(with, {*missed, {}});
        with->second.push_back(parameter.name);
      }
    std::vector<std::string> sentences;
    sentences.reserve(idle.size());
    for (const auto &[condition, names] : idle)
      sentences.push_back("without " +
                          std::regex_replace(condition, std::regex(" [|]|,"), " or") +
                          " these have no effect: " + join(names, ", "));
    return sentences;
  }

  ParameterSection
  ParameterSection::when(const std::string &condition) const
  {
    std::vector<std::string> alternatives = split(condition, '|');
    for (std::string &each : alternatives)
      if (each.find('/') == std::string::npos)
        each = path + "/" + each;
    ParameterSection result = *this;
    result.conditions.push_back(join(alternatives, " | "));
    return result;
  }

  Parameter &
  ParameterSection::append(Parameter parameter)
  {
    parameter.conditions = conditions;
    return table.add(std::move(parameter));
  }

  Parameter &
  ParameterSection::add(const std::string &name, bool &variable)
  {
    Parameter &parameter = add(name, variable, Names{"false", "true"});
    parameter.allowed    = "one of: true, false";
    return parameter;
  }

  Parameter &
  ParameterSection::add_path(const std::string &name,
                             std::string       &variable,
                             const std::string &keyword)
  {
    return append({path,
                   name,
                   variable,
                   keyword.empty() ? "a path" : keyword + ", or a path",
                   [&variable](const std::string &text) {
                     variable = text;
                     return true;
                   },
                   true,
                   keyword});
  }
} // namespace strait
