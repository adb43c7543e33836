// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/contact_area.h>
#include <strait/spectral/rows_around.h>

#include <cmath>

namespace strait
{
  ContactArea
  contact_area(const SlabField &pressure)
  {
    const SlabLayout &layout = pressure.layout();
    const int         nx = layout.grid().nx, n_rows = layout.n_rows();

    // The row after the last one belongs to another rank (or is the first one).
    const RowsAround rows(pressure);

    double n_contact = 0, n_edges = 0;
    for (int row = 0; row < n_rows; ++row)
      {
        const double *here = rows[row], *below = rows[row + 1];
        for (int ix = 0; ix < nx; ++ix)
          {
            const bool touches = here[ix] > 0;
            n_contact += touches;
            n_edges += touches != (here[ix + 1 < nx ? ix + 1 : 0] > 0);
            n_edges += touches != (below[ix] > 0);
          }
      }
    double sums[2] = {n_contact, n_edges};
    sum_in_place(layout.communicator(), sums, 2);

    // An edge is dx or dy long and its points dy or dx apart, so that S a is
    // dx dy an edge on a rectangular grid as well.
    const double n_points = static_cast<double>(layout.grid().n_points());
    ContactArea  area;
    area.fraction = sums[0] / n_points;
    area.corrected_fraction =
      (sums[0] - (M_PI - 1 + std::log(2.)) / 24 * sums[1]) / n_points;
    return area;
  }
} // namespace strait
