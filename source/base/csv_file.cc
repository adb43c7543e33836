// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/csv_file.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

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
  CsvFile::reopen(const std::string &path)
  {
    file_name = path;
    file.open(path, std::ios::app);
    if (!file)
      fail();
  }

  void
  CsvFile::write(const std::vector<std::string> &values)
  {
    std::error_code no_size;
    const auto      size = std::filesystem::file_size(file_name, no_size);
    file << join(values, ",") << std::endl;
    if (file)
      return;
    // Half a row would be worse than none.
    file.close();
    if (!no_size)
      std::filesystem::resize_file(file_name, size, no_size);
    fail();
  }

  void
  CsvFile::fail() const
  {
    throw ComputationError("The table '" + file_name +
                           "' could not be written; is the disk full?");
  }
} // namespace strait
