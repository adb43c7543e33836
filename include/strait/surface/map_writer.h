// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <string>

namespace strait
{
  /**
   * Write @p heights as a NetCDF file in the layout of contact.engineering, which
   * read_netcdf() reads: heights(x, y), and coordinates x and y with the attributes
   * length, periodic = 1 and unit. An empty @p unit is left out. Collective; throws
   * ComputationError on all ranks if the file cannot be written.
   */
  void write_netcdf_map(const std::string &path,
                        const SlabField   &heights,
                        const std::string &unit);
} // namespace strait
