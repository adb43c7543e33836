// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/grid_transfer.h>

#include <numeric>

namespace strait
{
  bool
  can_be_coarsened(const PeriodicGrid &grid)
  {
    return grid.nx % 2 == 0 && grid.ny % 2 == 0 && grid.nx >= 64 && grid.ny >= 64;
  }

  SlabField
  restrict_by_injection(const SlabField &fine)
  {
    const PeriodicGrid &g = fine.grid();
    SlabField           coarse(
      make_layout({g.nx / 2, g.ny / 2, g.lx, g.ly}, fine.layout().communicator()));
    const SlabLayout &layout = coarse.layout();

    std::vector<int> wanted(layout.n_rows());
    for (int row = 0; row < layout.n_rows(); ++row)
      wanted[row] = 2 * (layout.first_row() + row);
    const std::vector<double> rows = fetch_rows(fine, wanted);
    for (int row = 0; row < layout.n_rows(); ++row)
      for (int ix = 0; ix < g.nx / 2; ++ix)
        coarse(ix, row) = rows[static_cast<std::size_t>(row) * g.nx + 2 * ix];
    return coarse;
  }

  SlabField
  prolong_bilinearly(const SlabField &coarse, const SlabLayoutPtr &fine_layout)
  {
    SlabField fine(fine_layout);
    const int n = coarse.grid().nx, n_rows = fine_layout->n_rows();
    const int first = fine_layout->first_row() / 2;

    // All coarse rows that the local rows lie on or between.
    std::vector<int> wanted;
    if (n_rows > 0)
      wanted.resize((fine_layout->first_row() + n_rows) / 2 - first + 1);
    std::iota(wanted.begin(), wanted.end(), first);
    const std::vector<double> rows = fetch_rows(coarse, wanted);

    for (int row = 0; row < n_rows; ++row)
      {
        const int     iy    = fine_layout->first_row() + row;
        const double *lower = rows.data() + static_cast<std::size_t>(iy / 2 - first) * n;
        const double *upper = iy % 2 == 0 ? lower : lower + n;
        for (int ix = 0; ix < n; ++ix)
          {
            const int    next     = ix + 1 < n ? ix + 1 : 0;
            const double here     = 0.5 * (lower[ix] + upper[ix]);
            fine(2 * ix, row)     = here;
            fine(2 * ix + 1, row) = 0.5 * (here + 0.5 * (lower[next] + upper[next]));
          }
      }
    return fine;
  }
} // namespace strait
