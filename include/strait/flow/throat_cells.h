// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_throat_cells_h
#define strait_flow_throat_cells_h

#include <strait/percolation/channel.h>
#include <strait/spectral/grid_cell.h>

#include <set>

namespace strait
{
  /**
   * The cells of the grid's quadtree, of 2^@p largest_exponent spacings at most, that are
   * too large around the constrictions of which the narrowest point lies in a window:
   * larger than the spacing there and than half of their distance from that point. Each
   * lies in another one, unless it is as large as any.
   */
  std::set<GridCell> cells_around_throats(const Channel &channel, int largest_exponent);
} // namespace strait

#endif
