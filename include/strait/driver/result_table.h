// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_result_table_h
#define strait_driver_result_table_h

#include <strait/base/csv_file.h>
#include <strait/base/scene.h>
#include <strait/driver/step.h>

#include <functional>
#include <string>
#include <vector>

namespace strait
{
  /**
   * The table leakage.csv. Its columns, in their order, are those of the effects
   * that the scene enables; each row is on the disk before the next step begins.
   */
  class ResultTable
  {
  public:
    explicit ResultTable(const Scene &scene);

    /** Write the header line to @p path. Call on rank 0 only; throws
     *  ComputationError if the file cannot be written. */
    void open(const std::string &path);

    /** Continue the table in the file @p path; likewise. */
    void
    reopen(const std::string &path)
    {
      file.reopen(path);
    }

    /** Write and flush the row of @p step. Call on rank 0 only. */
    void append(const Step &step);

    std::vector<std::string> column_names() const;

  private:
    struct Column
    {
      std::string                              name;
      std::function<std::string(const Step &)> value;
    };

    void add(const std::string &name, std::function<double(const Step &)> value);
    void add_contact_columns();
    void add_flow_columns(const Scene &scene);
    void add_theory_columns(const Scene &scene);

    std::vector<Column> columns;
    CsvFile             file;
  };
} // namespace strait

#endif
