// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/files.h>
#include <strait/base/table.h>
#include <strait/base/text.h>
#include <strait/base/units.h>

#include <boost/algorithm/string.hpp>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <system_error>

namespace strait
{
  std::string
  in_units_of(const std::string &unit, const UnitParameters &units)
  {
    std::string result = unit;
    boost::replace_first(result, "length", units.length);
    boost::replace_first(result, "pressure", units.pressure);
    boost::replace_first(result, "time", units.time);
    return result;
  }

  void
  print_markdown(std::ostream &out, const TableInfo &table)
  {
    out << "## " << table.file << "\n\n"
        << table.definition << "\n\n| column | unit | definition |\n|---|---|---|\n";
    for (const ColumnInfo &column : table.columns)
      out << "| `" << column.name << "` | "
          << (column.unit.empty() ? "text" : column.unit) << " | " << column.definition
          << " |\n";
    out << "\n";
  }

  TableFile::TableFile(const std::string &file_,
                       const Condition   &condition,
                       const std::string &definition)
    : table_condition(condition)
    , about{file_,
            (condition.text.empty() ? "" : "Written " + condition.text + ". ") +
              definition,
            {}}
  {
  }

  void
  TableFile::declare(const std::string &text)
  {
    const auto        colon      = text.find(": ");
    const std::string heading    = text.substr(0, colon),
                      definition = text.substr(colon + 2);
    const auto bracket           = heading.find(" [");
    const bool is_text           = bracket == std::string::npos;
    about.columns.push_back(
      {heading.substr(0, bracket),
       is_text ? "" : heading.substr(bracket + 2, heading.size() - bracket - 3),
       definition +
         (column_condition.text.empty() ? "" : "; only " + column_condition.text),
       table_condition.holds && column_condition.holds});
  }

  void
  TableFile::open(const std::string &folder, const bool anew)
  {
    file_name = folder + "/" + about.file;
    std::error_code error;
    if (anew)
      std::filesystem::remove(file_name, error);
    if (error)
      throw_unfinished("The file '" + file_name + "'", error.value());
    write({}); // the header
  }

  void
  TableFile::write(const std::vector<std::string> &entries)
  {
    // Opened by name each time, so that a file that another program has put in its place
    // is continued.
    std::error_code error;
    const bool      is_new = !std::filesystem::exists(file_name, error);
    const auto      size   = is_new ? 0 : std::filesystem::file_size(file_name, error);
    std::ofstream   file(file_name, std::ios::app);
    if (is_new)
      {
        std::vector<std::string> names;
        for (const ColumnInfo &column : about.columns)
          if (column.is_written)
            names.push_back(column.name);
        file << join(names, ",") << '\n';
      }
    if (!entries.empty())
      file << join(entries, ",") << '\n';
    file.close();
    if (file)
      return;
    // Half a row would be worse than none, and a table without a header worse than none.
    if (!error && is_new)
      std::filesystem::remove(file_name, error);
    else if (!error)
      std::filesystem::resize_file(file_name, size, error);
    throw_unfinished("The file '" + file_name + "'");
  }
} // namespace strait
