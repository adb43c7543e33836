// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_rows_around_h
#define strait_spectral_rows_around_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /** This rank's rows of the grid, with the one before and the one after them. */
  class RowsAround
  {
  public:
    /** @p field must outlive this object. Collective. */
    explicit RowsAround(const SlabField &field_)
      : field(field_)
    {
      const int        first = field.layout().first_row();
      const int        end   = first + field.layout().n_rows();
      std::vector<int> wanted;
      if (end > first)
        wanted = {first - 1, end};
      neighbours = fetch_rows(field, wanted);
    }

    /** @p row counts this rank's rows: −1 <= @p row <= their number. */
    const double *
    operator[](const int row) const
    {
      const int nx = field.grid().nx, n_rows = field.layout().n_rows();
      return row < 0         ? neighbours.data()
             : row == n_rows ? neighbours.data() + nx
                             : field.data() + static_cast<std::size_t>(row) * nx;
    }

  private:
    const SlabField    &field;
    std::vector<double> neighbours;
  };
} // namespace strait

#endif
