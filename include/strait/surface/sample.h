// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_sample_h
#define strait_surface_sample_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /** The field height(x, y) at the points of this rank; no communication. */
  template <class Height>
  SlabField
  sample(const SlabLayoutPtr &layout, const Height &height)
  {
    const PeriodicGrid &grid = layout->grid();
    SlabField           field(layout);
    for (int row = 0; row < layout->n_rows(); ++row)
      {
        const double y = (layout->first_row() + row) * grid.dy();
        for (int ix = 0; ix < grid.nx; ++ix)
          field(ix, row) = height(ix * grid.dx(), y);
      }
    return field;
  }
} // namespace strait

#endif
