// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/surface/map_writer.h>
#include <strait/surface/readers/height_map.h>

#include <cstdint>
#include <cstring>
#include <fstream>

namespace strait
{
  namespace
  {
    // What the classic format calls its lists.
    constexpr std::uint64_t list_of_dimensions = 10, list_of_variables = 11,
                            list_of_attributes = 12;

    void
    append(std::string &to, const std::uint64_t value, const int n_bytes)
    {
      for (int shift = 8 * (n_bytes - 1); shift >= 0; shift -= 8)
        to += static_cast<char>(value >> shift & 0xff);
    }

    void
    append(std::string &to, const double value)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof(bits));
      append(to, bits, 8);
    }

    /** Length and letters, padded to four bytes. */
    void
    append(std::string &to, const std::string &text)
    {
      append(to, text.size(), 4);
      to += text + std::string((4 - text.size() % 4) % 4, '\0');
    }

    /** A variable in a header: its name, its dimensions, and a side's or only a unit. */
    struct VariableEntry
    {
      std::string           name;
      std::vector<unsigned> dimensions;
      double                length; // of a side; 0: it is none
      std::uint64_t         n_values;
    };

    void
    append_attributes(std::string &to, const double length, const std::string &unit)
    {
      const unsigned n = (length > 0 ? 2 : 0) + (unit.empty() ? 0 : 1);
      append(to, n > 0 ? list_of_attributes : 0, 4);
      append(to, n, 4);
      if (length > 0)
        {
          append(to, "length");
          append(to, type_double, 4);
          append(to, 1, 4);
          append(to, length);
          append(to, "periodic");
          append(to, type_int, 4);
          append(to, 1, 4);
          append(to, 1, 4);
        }
      if (!unit.empty())
        {
          append(to, "unit");
          append(to, type_char, 4);
          append(to, unit);
        }
    }

    /** The header of CDF-2, with variables one after the other behind it. */
    std::string
    header_of(const PeriodicGrid &grid, const std::string &unit)
    {
      const auto                       nx          = static_cast<std::uint64_t>(grid.nx);
      const auto                       ny          = static_cast<std::uint64_t>(grid.ny);
      const std::vector<VariableEntry> variables   = {{"x", {0}, grid.lx, nx},
                                                      {"y", {1}, grid.ly, ny},
                                                      {"heights", {0, 1}, 0., nx * ny}};
      const auto                       header_with = [&](std::uint64_t begin) {
        std::string header("CDF\2\0\0\0\0", 8);
        append(header, list_of_dimensions, 4);
        append(header, 2, 4);
        append(header, "x");
        append(header, nx, 4);
        append(header, "y");
        append(header, ny, 4);
        append(header, 0, 8); // no attributes of the file
        append(header, list_of_variables, 4);
        append(header, variables.size(), 4);
        for (const VariableEntry &variable : variables)
          {
            append(header, variable.name);
            append(header, variable.dimensions.size(), 4);
            for (const unsigned dimension : variable.dimensions)
              append(header, dimension, 4);
            append_attributes(header, variable.length, unit);
            append(header, type_double, 4);
            // The last variable may exceed what fits here; this is then how it is said.
            append(header, std::min<std::uint64_t>(8 * variable.n_values, 0xffffffff), 4);
            append(header, begin, 8);
            begin += 8 * variable.n_values;
          }
        return header;
      };
      // The length of the header, which places the variables, does not depend on them.
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
