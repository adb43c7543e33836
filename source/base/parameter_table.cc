// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace strait
{
  namespace
  {
    using Tree = boost::property_tree::ptree;

    /** Undo ParameterHandler's "_20" for a blank and the like. */
    std::string
    demangle(const std::string &key)
    {
      std::string name;
      for (std::size_t i = 0; i < key.size(); ++i)
        if (key[i] == '_' && i + 2 < key.size())
          {
            name += static_cast<char>(std::stoi(key.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          name += key[i];
      return name;
    }

    bool
    starts_with(const std::string &text, const std::string &start)
    {
      return text.compare(0, start.size(), start) == 0;
    }

    /** ParameterHandler's description of a pattern in words. */
    std::string
    in_words(const std::string &pattern)
    {
      if (starts_with(pattern, "[List of <[Double"))
        return "numbers separated by commas";
      if (starts_with(pattern, "[List of <[Integer"))
        return "integers separated by commas";
      if (starts_with(pattern, "[Double"))
        return "a number";
      if (starts_with(pattern, "[Integer"))
        return "an integer";
      if (starts_with(pattern, "[Bool"))
        return "true or false";
      const std::string selection = "[Selection ";
      if (starts_with(pattern, selection))
        return "one of: " +
               join(split(pattern.substr(selection.size(),
                                         pattern.rfind(']') - selection.size()),
                          '|'),
                    ", ");
      return "text";
    }

    void
    collect(const Tree                            &tree,
            const std::vector<std::string>        &section,
            std::vector<ParameterInfo>            &parameters,
            std::vector<std::vector<std::string>> &sections)
    {
      if (!section.empty())
        sections.push_back(section);
      for (const auto &[key, child] : tree)
        if (child.find("pattern_description") != child.not_found())
          parameters.push_back({section,
                                demangle(key),
                                child.get<std::string>("default_value"),
                                child.get<std::string>("documentation"),
                                in_words(child.get<std::string>("pattern_description"))});
        else
          {
            std::vector<std::string> inner = section;
            inner.push_back(demangle(key));
            collect(child, inner, parameters, sections);
          }
    }

    const char *const see_list = "; 'strait --parameters' lists all names.";
  } // namespace

  std::string
  ParameterInfo::path() const
  {
    return join(section, "/") + (section.empty() ? "" : "/") + name;
  }

  ParameterTable::ParameterTable(const dealii::ParameterHandler &prm)
  {
    std::stringstream json;
    prm.print_parameters(json,
                         dealii::ParameterHandler::JSON |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    Tree tree;
    boost::property_tree::read_json(json, tree);
    collect(tree, {}, all, sections);
  }

  void
  ParameterTable::check_section(const SceneEntry &entry) const
  {
    for (std::size_t depth = 1; depth <= entry.section.size(); ++depth)
      {
        const std::vector<std::string> part(entry.section.begin(),
                                            entry.section.begin() + depth);
        if (std::find(sections.begin(), sections.end(), part) != sections.end())
          continue;
        // First among the sections at this place, then anywhere.
        std::vector<std::string> siblings, anywhere;
        for (const auto &section : sections)
          {
            anywhere.push_back(join(section, "/"));
            if (section.size() == depth &&
                std::equal(part.begin(), part.end() - 1, section.begin()))
              siblings.push_back(section.back());
          }
        std::string nearest = nearest_name(part.back(), siblings);
        if (nearest.empty())
          nearest = nearest_name(join(part, "/"), anywhere);
        throw InputError(entry.place + ": unknown subsection '" + join(part, "/") + "'" +
                         suggestion(nearest, see_list));
      }
  }

  const ParameterInfo &
  ParameterTable::find(const SceneEntry &entry) const
  {
    std::vector<std::string> siblings;
    for (const ParameterInfo &info : all)
      if (info.section == entry.section)
        {
          if (info.name == entry.name)
            return info;
          siblings.push_back(info.name);
        }
    std::string nearest = nearest_name(entry.name, siblings);
    if (nearest.empty())
      {
        std::vector<std::string> names;
        for (const ParameterInfo &info : all)
          names.push_back(info.name);
        const std::string name = nearest_name(entry.name, names);
        for (const ParameterInfo &info : all)
          if (nearest.empty() && !name.empty() && info.name == name)
            nearest = info.path();
      }
    throw InputError(entry.place + ": unknown parameter '" + entry.name + "' " +
                     (entry.section.empty()
                        ? "outside every subsection"
                        : "in subsection '" + join(entry.section, "/") + "'") +
                     suggestion(nearest, see_list));
  }

  void
  ParameterTable::assign(dealii::ParameterHandler &prm, const SceneEntry &entry) const
  {
    check_section(entry);
    if (entry.name.empty())
      return;
    const ParameterInfo &info = find(entry);
    for (const std::string &section : info.section)
      prm.enter_subsection(section);
    bool fits = true;
    try
      {
        prm.set(info.name, entry.value);
      }
    catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
      {
        fits = false;
      }
    for (std::size_t i = 0; i < info.section.size(); ++i)
      prm.leave_subsection();
    if (!fits)
      throw InputError(entry.place + ": '" + entry.value + "' is no value for " +
                       info.path() + "; expected " + info.allowed + ".");
  }

  namespace
  {
    /** Text in which nothing marks up. */
    std::string
    escaped(const std::string &text)
    {
      std::string result;
      for (const char character : text)
        {
          if (character == '|' || character == '*' || character == '_')
            result += '\\';
          result += character;
        }
      return result;
    }
  } // namespace

  void
  print_markdown(std::ostream &out, const ParameterTable &table)
  {
    out
      << "# Parameters\n\n"
      << "All parameters of a scene, section by section, as `strait --parameters md` "
         "prints them;\n`strait --parameters prm` prints a scene with every default. The "
         "unit stands in brackets,\n[1] for a number without one.\n\n";
    std::vector<std::string> section;
    for (const ParameterInfo &info : table.parameters())
      {
        if (info.section != section)
          {
            section = info.section;
            out << "## " << join(section, " / ") << "\n\n"
                << "| Parameter | Default | Values | Meaning |\n|-|-|-|-|\n";
          }
        out << "| " << info.name << " | "
            << (info.default_value.empty() ? "" : "`" + info.default_value + "`") << " | "
            << info.allowed << " | " << escaped(info.documentation) << " |\n";
        if (&info == &table.parameters().back() || (&info + 1)->section != section)
          out << "\n";
      }
  }

  std::vector<double>
  parse_numbers(const std::string &text)
  {
    std::vector<double> numbers;
    for (const std::string &part : split(text, ','))
      if (!trim(part).empty())
        numbers.push_back(std::stod(part));
    return numbers;
  }

  std::array<double, 2>
  parse_pair(const std::string &text)
  {
    const std::vector<double> numbers = parse_numbers(text);
    return {{numbers.front(), numbers.back()}};
  }
} // namespace strait
