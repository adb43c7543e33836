// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/text.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  struct UnitParameters;

  /** When a table or a column is written. */
  struct Condition
  {
    std::string text;         // "with `Theory/Enabled`"; empty: nothing needs to be said
    bool        holds = true; // for the scene at hand
  };

  /** What a column of a table holds. */
  struct ColumnInfo
  {
    std::string name;
    std::string unit;       // in terms of length, pressure and time; "1"; empty: a text
    std::string definition; // Markdown
    bool        is_written;
  };

  /** What a table holds. */
  struct TableInfo
  {
    std::string             file;       // STEP stands for the number of a step
    std::string             definition; // Markdown
    std::vector<ColumnInfo> columns;    // in order, with those not written
  };

  /** @p unit with the names of a scene's units: "length³/time" gives "m³/s". */
  std::string in_units_of(const std::string &unit, const UnitParameters &units);

  /** Print a heading, the definition of the table, and its columns. */
  void print_markdown(std::ostream &out, const TableInfo &table);

  /** A file of comma-separated values whose rows are in the file as soon as they are
   *  appended. Only one rank may write. The functions throw ComputationError if the file
   *  cannot be written; the table then ends with the row before. */
  class TableFile
  {
  public:
    TableFile(const std::string &file,
              const Condition   &condition,
              const std::string &definition);

    const TableInfo &
    info() const
    {
      return about;
    }

    /** Add a column "name [unit]: definition", or "name: definition" for texts. */
    void declare(const std::string &text);

    /** Continue the table in its file in @p folder. If there is no file, or if @p anew,
     *  begin it there with the header line. */
    void open(const std::string &folder, bool anew = false);

  protected:
    /** Append a line with one entry for each column that is written. Without entries,
     *  make sure only that the file has its header. */
    void write(const std::vector<std::string> &entries);

    Condition table_condition, column_condition; // of columns that are declared next

  private:
    TableInfo   about;
    std::string file_name;
  };

  /** A table whose columns take their entries from a @p Row. */
  template <typename Row>
  class Table : public TableFile
  {
  public:
    using TableFile::TableFile;

    /** The columns that are added from now on are written only where @p condition
     *  holds. */
    Table &
    when(const Condition &condition = {})
    {
      column_condition = condition;
      return *this;
    }

    /** Add a column. @p value is a member of a row or a function of it, a number or a
     *  text. @p text is "name [unit]: definition" with a unit in terms of length,
     *  pressure and time, 1 for plain numbers, or "name: definition" for texts. */
    template <typename Value>
    Table &
    add(Value value, const std::string &text)
    {
      declare(text);
      values.push_back([value](const Row &row) {
        using Entry       = std::decay_t<decltype(std::invoke(value, row))>;
        const Entry entry = std::invoke(value, row);
        if constexpr (std::is_floating_point_v<Entry>)
          return format("%.17g", entry); // all its digits
        else if constexpr (std::is_integral_v<Entry>)
          return std::to_string(entry);
        else
          return std::string(entry);
      });
      return *this;
    }

    /** Append a row to the file. */
    void
    append(const Row &row)
    {
      std::vector<std::string> entries;
      for (std::size_t k = 0; k < values.size(); ++k)
        if (info().columns[k].is_written)
          entries.push_back(values[k](row));
      write(entries);
    }

    /** Write a whole table to its file in @p folder, replacing an earlier one. */
    void
    write_rows(const std::string &folder, const std::vector<Row> &rows)
    {
      open(folder, true);
      for (const Row &row : rows)
        append(row);
    }

  private:
    std::vector<std::function<std::string(const Row &)>> values; // of all columns
  };
} // namespace strait
