// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/table.h>
#include <strait/base/text.h>
#include <strait/base/unit_parameters.h>

#include <cstdio>
#include <filesystem>
#include <ostream>
#include <system_error>

namespace strait
{
  std::string
  in_units_of(const std::string &unit, const UnitParameters &units)
  {
    std::string result = unit;
    const auto  put    = [&result](const std::string &quantity, const std::string &own) {
      const auto at = result.find(quantity);
      if (at != std::string::npos)
        result.replace(at, quantity.size(), own);
    };
    put("length", units.length);
    put("pressure", units.pressure);
    put("time", units.time);
    return result;
  }

  void
  print_markdown(std::ostream &out, const TableInfo &table)
  {
    out << "## " << table.file << "\n\n"
        << table.definition << "\n\n| column | unit | definition |\n|---|---|---|\n";
    for (const auto &[name, unit, definition, condition] : table.columns)
      out << "| `" << name << "` | " << (unit.empty() ? "text" : unit) << " | "
          << definition << (condition.text.empty() ? "" : "; only " + condition.text)
          << " |\n";
    out << "\n";
  }

  std::string
  full_precision(const double value)
  {
    return format("%.17g", value);
  }

  TableFile::TableFile(std::string      file_,
                       const Condition &condition,
                       std::string      definition)
    : of_table(condition)
    , about{std::move(file_), std::move(definition), {}}
  {
    if (!condition.text.empty())
      about.definition = "Written " + condition.text + ". " + about.definition;
  }

  void
  TableFile::declare(const std::string &heading, const std::string &definition)
  {
    const auto bracket = heading.find(" [");
    about.columns.push_back(
      {heading.substr(0, bracket),
       bracket == std::string::npos
         ? ""
         : heading.substr(bracket + 2, heading.size() - bracket - 3),
       definition,
       {of_columns.text, of_columns.holds && of_table.holds}});
  }

  void
  TableFile::open(const std::string &path)
  {
    file_name = path;
    file      = std::ofstream(path);
    std::vector<std::string> names;
    for (const ColumnInfo &column : about.columns)
      if (column.condition.holds)
        names.push_back(column.name);
    write(names);
  }

  void
  TableFile::reopen(const std::string &path)
  {
    file_name = path;
    file      = std::ofstream(path, std::ios::app);
    if (!file)
      fail();
  }

  void
  TableFile::write(const std::vector<std::string> &entries)
  {
    std::error_code no_size;
    const auto      size = std::filesystem::file_size(file_name, no_size);
    file << join(entries, ",") << std::endl;
    if (file)
      return;
    // Half a row would be worse than none.
    file.close();
    if (!no_size)
      std::filesystem::resize_file(file_name, size, no_size);
    fail();
  }

  void
  TableFile::fail() const
  {
    throw ComputationError("The table '" + file_name +
                           "' could not be written; is the disk full?");
  }
} // namespace strait
