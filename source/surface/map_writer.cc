// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/surface/map_writer.h>
#include <strait/surface/readers/netcdf_header.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <type_traits>

namespace strait
{
  namespace
  {
    // The tags of lists in the classic format.
    constexpr std::uint32_t list_of_dimensions = 10, list_of_variables = 11,
                            list_of_attributes = 12;

    /** Append the bytes of @p number, the most significant first. */
    template <typename Number>
    std::enable_if_t<std::is_arithmetic_v<Number>>
    append(std::string &to, const Number number)
    {
      unsigned char bytes[sizeof(Number)];
      boost::endian::endian_store<Number, sizeof(Number), boost::endian::order::big>(
        bytes, number);
      to.append(std::begin(bytes), std::end(bytes));
    }

    void
    append(std::string &to, const std::initializer_list<std::uint32_t> words)
    {
      for (const std::uint32_t word : words)
        append(to, word);
    }

    /** Append length and characters of @p text, padded to four bytes. */
    void
    append(std::string &to, const std::string &text)
    {
      append(to, static_cast<std::uint32_t>(text.size()));
      to += text + std::string((4 - text.size() % 4) % 4, '\0');
    }

    /** Append the attributes of a variable; @p length is 0 if it is not a coordinate. */
    void
    append_attributes(std::string &to, const double length, const std::string &unit)
    {
      const std::uint32_t n = (length > 0 ? 2 : 0) + (unit.empty() ? 0 : 1);
      append(to, {n > 0 ? list_of_attributes : 0, n});
      if (length > 0)
        {
          append(to, "length");
          append(to, {type_double, 1});
          append(to, length);
          append(to, "periodic");
          append(to, {type_int, 1, 1});
        }
      if (!unit.empty())
        {
          append(to, "unit");
          append(to, {type_char});
          append(to, unit);
        }
    }

    /** The header of a CDF-2 file, for variables that follow it one after the other. */
    std::string
    header_of(const PeriodicGrid &grid, const std::string &unit)
    {
      const auto nx          = static_cast<std::uint32_t>(grid.nx);
      const auto ny          = static_cast<std::uint32_t>(grid.ny);
      const auto header_with = [&](std::uint64_t begin) {
        std::string header("CDF\2\0\0\0\0", 8);
        append(header, {list_of_dimensions, 2});
        append(header, "x");
        append(header, nx);
        append(header, "y");
        append(header, ny);
        append(header, {0, 0}); // no attributes of the file
        append(header, {list_of_variables, 3});
        const auto add = [&](const char                       *name,
                             const std::vector<std::uint32_t> &dimensions,
                             const double                      length,
                             const std::uint64_t               n_values) {
          append(header, name);
          append(header, static_cast<std::uint32_t>(dimensions.size()));
          for (const std::uint32_t dimension : dimensions)
            append(header, dimension);
          append_attributes(header, length, unit);
          // If the size of the last variable exceeds 32 bits, the format wants all set.
          append(header,
                 {type_double,
                  static_cast<std::uint32_t>(
                    std::min<std::uint64_t>(8 * n_values, 0xffffffff))});
          append(header, begin);
          begin += 8 * n_values;
        };
        add("x", {0}, grid.lx, nx);
        add("y", {1}, grid.ly, ny);
        add("heights", {0, 1}, 0., static_cast<std::uint64_t>(nx) * ny);
        return header;
      };
      // The length of the header does not depend on the positions that follow from it.
      return header_with(header_with(0).size());
    }
  } // namespace

  void
  write_netcdf_map(const std::string &path,
                   const SlabField   &heights,
                   const std::string &unit)
  {
    const PeriodicGrid       &grid  = heights.grid();
    const std::vector<double> whole = gather_on_root(heights);
    run_on_root(heights.layout().communicator(), [&]() {
      std::ofstream file(path, std::ios::binary | std::ios::trunc);
      std::string   content = header_of(grid, unit);
      for (int ix = 0; ix < grid.nx; ++ix)
        append(content, ix * grid.dx());
      for (int iy = 0; iy < grid.ny; ++iy)
        append(content, iy * grid.dy());
      file << content;
      for (int ix = 0; ix < grid.nx; ++ix)
        {
          content.clear();
          for (int iy = 0; iy < grid.ny; ++iy)
            append(content, whole[static_cast<std::size_t>(iy) * grid.nx + ix]);
          file << content;
        }
      file.close();
      if (!file)
        throw_unfinished("The file '" + path + "'");
    });
  }
} // namespace strait
