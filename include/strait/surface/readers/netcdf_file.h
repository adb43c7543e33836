// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_netcdf_file_h
#define strait_surface_readers_netcdf_file_h

#include <strait/base/units.h>

#include <cstdint>
#include <optional>
#include <string>

namespace strait
{
  /** A NetCDF file open for reading, closed when it goes out of scope. */
  class NetcdfFile
  {
  public:
    explicit NetcdfFile(const std::string &name);
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile &)            = delete;
    NetcdfFile &operator=(const NetcdfFile &) = delete;

    int  id = -1;
    bool is_open;
  };

  /** The attribute @p name of a variable; nothing if it is absent or no single number. */
  std::optional<double> number_attribute(int file, int variable, const char *name);

  /** The attribute @p name of a variable; empty if it is absent or no text. */
  std::string text_attribute(int file, int variable, const char *name);

  /** The attribute "unit", or else "units", of a variable. */
  LengthUnit unit_attribute(int file, int variable);

  /**
   * Where the values of variable number @p variable begin in a NetCDF file of a
   * classic format (CDF-1, -2 or -5), in bytes from the start of the file. The
   * library does not tell, and reads zeros where a file was cut off. Nothing if
   * the header cannot be followed so far.
   */
  std::optional<std::uint64_t> begin_of_classic_variable(const std::string &file,
                                                         int                variable);
} // namespace strait

#endif
