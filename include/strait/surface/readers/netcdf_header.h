// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** The codes of types in the classic format of NetCDF. */
  enum NetcdfType : std::uint64_t
  {
    type_byte   = 1,
    type_char   = 2,
    type_short  = 3,
    type_int    = 4,
    type_float  = 5,
    type_double = 6
  };

  /**
   * The header of a file in the classic format of NetCDF (CDF-1 or CDF-2): big-endian
   * numbers, and texts padded to four bytes. It is never read beyond the end of the file,
   * whatever the counts in it claim. The constructor throws InputError if the file ends
   * within its header.
   */
  class NetcdfHeader
  {
  public:
    /** A property of the file or of a variable. */
    struct Attribute
    {
      std::string           text;
      std::optional<double> number; // if there is exactly one
    };

    /** An axis of variables, with its number of values. */
    struct Dimension
    {
      std::string   name;
      std::uint64_t n = 0;
    };

    /** An array, and where its values are in the file. */
    struct Variable
    {
      std::vector<std::uint64_t>       dimensions; // by their numbers
      std::map<std::string, Attribute> attributes;
      std::uint64_t                    type  = 0;
      std::uint64_t                    begin = 0; // bytes from the start of the file

      /** The attribute @p name; an empty one if there is none. */
      const Attribute &operator[](const std::string &name) const;

      /** Whether the values are numbers. */
      bool is_number() const;

      /** The bytes of a value. */
      std::uint64_t item_size() const;

      /** The value whose bytes, the most significant first, are at @p bytes. */
      double decode(const char *bytes) const;
    };

    explicit NetcdfHeader(const std::string &file);

    std::vector<Dimension>          dimensions;
    std::map<std::string, Variable> variables;

  private:
    // Each of these reads what is next in the header.
    std::string                      take(std::uint64_t n_bytes);
    std::uint64_t                    number(int n_bytes);
    std::string                      padded(std::uint64_t n_bytes);
    std::string                      text();
    std::uint64_t                    length_of_list();
    std::map<std::string, Attribute> attributes();

    std::string file;
    std::string content;
    std::size_t position = 0;
  };
} // namespace strait
