// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_grid_description_h
#define strait_run_grid_description_h

#include <strait/spectral/slab_field.h>

#include <string>
#include <vector>

namespace strait
{
  /** A data set of shape (ny, nx) in an HDF5 file. */
  struct GridDataset
  {
    std::string name;
    bool        is_whole = false; // of whole numbers of 4 bytes, else doubles
  };

  /**
   * The text of an XDMF file (version 2, as ParaView reads it) beside the HDF5 file
   * @p file, with each of @p datasets at the points of @p grid in the plane z = 0.
   */
  std::string grid_description(const std::string              &file,
                               const PeriodicGrid             &grid,
                               const std::vector<GridDataset> &datasets);
} // namespace strait

#endif
