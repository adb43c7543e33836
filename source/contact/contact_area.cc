// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/contact_area.h>
#include <strait/reference/wavy_contact.h>

namespace strait
{
  ContactArea
  contact_area(const SlabField &pressure)
  {
    const SlabLayout &layout = pressure.layout();
    const int         nx = layout.grid().nx, n_rows = layout.n_rows();

    // The row below the last one belongs to another rank (or is the first one).
    std::vector<int> wanted;
    if (n_rows > 0)
      wanted.push_back(layout.first_row() + n_rows);
    const std::vector<double> row_below = fetch_rows(pressure, wanted);

    double n_contact = 0, n_edges = 0;
    for (int row = 0; row < n_rows; ++row)
      {
        const double *here  = pressure.data() + static_cast<std::size_t>(row) * nx;
        const double *below = row + 1 < n_rows ? here + nx : row_below.data();
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
      reference::corrected_contact_area(sums[0], sums[1], 1.) / n_points;
    return area;
  }
} // namespace strait
