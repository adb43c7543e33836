// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/csv_file.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>

#include <cstdio>

namespace strait
{
  std::string
  full_precision(const double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
  }

  void
  CsvFile::open(const std::string &path, const std::vector<std::string> &column_names)
  {
    file_name = path;
    file.open(path);
    write(column_names);
  }

  void
  CsvFile::append(const std::vector<std::string> &values)
  {
    write(values);
  }

  void
  CsvFile::write(const std::vector<std::string> &values)
  {
    file << join(values, ",") << std::endl;
    if (!file)
      throw ComputationError("The table '" + file_name +
                             "' could not be written; is the disk full?");
  }
} // namespace strait
