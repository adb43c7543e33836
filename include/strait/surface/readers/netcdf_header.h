// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_netcdf_header_h
#define strait_surface_readers_netcdf_header_h

#include <cstdint>
#include <optional>
#include <string>

namespace strait
{
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
