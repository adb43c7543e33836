// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_csv_file_h
#define strait_base_csv_file_h

#include <fstream>
#include <string>
#include <vector>

namespace strait
{
  /** A number with all its digits, as it is written to tables. */
  std::string full_precision(double value);

  /**
   * A table of comma-separated values whose rows are on the disk as soon as they
   * are appended. For one rank only.
   */
  class CsvFile
  {
  public:
    /** Write the header line. Throws ComputationError if @p path cannot be
     *  written. */
    void open(const std::string &path, const std::vector<std::string> &column_names);

    /** Continue the table in the file @p path. Throws ComputationError if it cannot be
     *  written. */
    void reopen(const std::string &path);

    /** Throws ComputationError if the row could not be written; then the table ends
     *  with the row before. */
    void append(const std::vector<std::string> &values);

  private:
    void write(const std::vector<std::string> &values);

    [[noreturn]] void fail() const;

    std::string   file_name;
    std::ofstream file;
  };
} // namespace strait

#endif
