// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_netcdf_h
#define strait_surface_readers_netcdf_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /** Whether an HDF5 file was written by the NetCDF library. */
  bool is_netcdf4(const std::string &file);

  /**
   * Read a two-dimensional variable of a NetCDF file, classic or NetCDF-4: the
   * one that source.dataset names, or "heights", or the only one. The dimension
   * called x (else the last) runs along x. Coordinate variables x and y may have
   * the attributes "length" (of the whole side), "unit" and "periodic", or else
   * give the spacing; the attribute "unit" or "units" of the heights is their
   * unit. "scale_factor", "add_offset", "_FillValue" and "missing_value" have
   * their usual meaning. This is the layout of contact.engineering.
   */
  HeightMap read_netcdf(const MapSource &source);
} // namespace strait

#endif
