// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_parameter_table_h
#define strait_base_parameter_table_h

#include <strait/base/scene_text.h>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  /** What is declared of one parameter. */
  struct ParameterInfo
  {
    std::vector<std::string> section;
    std::string              name;
    std::string              default_value;
    std::string              documentation;
    std::string              allowed; // "a number", "one of: a, b, c", ...

    /** "Section/Subsection/Name". */
    std::string path() const;
  };

  /** All declared parameters in the order of their declaration. */
  class ParameterTable
  {
  public:
    explicit ParameterTable(const dealii::ParameterHandler &prm);

    const std::vector<ParameterInfo> &
    parameters() const
    {
      return all;
    }

    /**
     * Give the handler the value of @p entry. Throws InputError, with the place
     * of the entry and the nearest known name, for a section or parameter that
     * is not declared, and for a value of the wrong kind.
     */
    void assign(dealii::ParameterHandler &prm, const SceneEntry &entry) const;

  private:
    void                 check_section(const SceneEntry &entry) const;
    const ParameterInfo &find(const SceneEntry &entry) const;

    std::vector<ParameterInfo>            all;
    std::vector<std::vector<std::string>> sections;
  };

  /** Markdown: a heading and a table for each section. */
  void print_markdown(std::ostream &out, const ParameterTable &table);

  /** The numbers of a list, which may be empty. */
  std::vector<double> parse_numbers(const std::string &text);

  /** The one or two entries of a list; one stands for both directions. */
  std::array<double, 2> parse_pair(const std::string &text);
} // namespace strait

#endif
