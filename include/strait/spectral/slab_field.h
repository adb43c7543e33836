// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_slab_field_h
#define strait_spectral_slab_field_h

#include <strait/spectral/slab_layout.h>

#include <cstddef>
#include <vector>

namespace strait
{
  /**
   * One real number per grid point, in slabs: this rank holds its rows one
   * after the other, x fastest, without padding. The values of the layout's windows
   * follow, the same on all ranks.
   */
  class SlabField
  {
  public:
    SlabField() = default;

    explicit SlabField(SlabLayoutPtr layout, const double value = 0.)
      : slab_layout(std::move(layout))
      , values(slab_layout->n_values(), value)
    {
    }

    const SlabLayout &
    layout() const
    {
      return *slab_layout;
    }

    const SlabLayoutPtr &
    layout_pointer() const
    {
      return slab_layout;
    }

    const PeriodicGrid &
    grid() const
    {
      return slab_layout->grid();
    }

    /** True before a layout was given. */
    bool
    empty() const
    {
      return slab_layout == nullptr;
    }

    /** Number of local values, those of windows included. */
    std::size_t
    size() const
    {
      return values.size();
    }

    double *
    data()
    {
      return values.data();
    }

    const double *
    data() const
    {
      return values.data();
    }

    double &
    operator[](const std::size_t local_index)
    {
      return values[local_index];
    }

    double
    operator[](const std::size_t local_index) const
    {
      return values[local_index];
    }

    /** Value at column @p ix of the local row @p local_row. */
    double &
    operator()(const int ix, const int local_row)
    {
      return values[static_cast<std::size_t>(local_row) * grid().nx + ix];
    }

    double
    operator()(const int ix, const int local_row) const
    {
      return values[static_cast<std::size_t>(local_row) * grid().nx + ix];
    }

    std::vector<double>::iterator
    begin()
    {
      return values.begin();
    }

    std::vector<double>::iterator
    end()
    {
      return values.end();
    }

    std::vector<double>::const_iterator
    begin() const
    {
      return values.begin();
    }

    std::vector<double>::const_iterator
    end() const
    {
      return values.end();
    }

  private:
    SlabLayoutPtr       slab_layout;
    std::vector<double> values;
  };

  /** Mean over the box. Collective. */
  double mean(const SlabField &field);

  /** Root mean square about the mean. Collective. */
  double rms(const SlabField &field);

  /** Smallest value. Collective. */
  double min_value(const SlabField &field);

  /** Largest value. Collective. */
  double max_value(const SlabField &field);

  /**
   * Collective: the rows @p rows of the grid (global numbers, any order, taken modulo ny)
   * of @p field, one after the other. Each rank may ask for other rows.
   */
  std::vector<double> fetch_rows(const SlabField &field, const std::vector<int> &rows);

  /** The same of any array of @p row_length numbers a row, double, float or std::int64_t,
   *  laid out like @p layout. */
  template <class Number>
  std::vector<Number> fetch_rows(const SlabLayout       &layout,
                                 const Number           *local_rows,
                                 int                     row_length,
                                 const std::vector<int> &rows);

  /** The adjoint: add row k of @p values to the row rows[k], which is not negative, of
   * the rank that owns it, one rank after the other. Collective. */
  void add_rows(const SlabLayout          &layout,
                const std::vector<int>    &rows,
                const std::vector<double> &values,
                double                    *local_rows);

  /** Collective: the whole grid of a field on rank 0 (empty elsewhere), row by row. */
  std::vector<double> gather_on_root(const SlabField &field);

  /** Collective: distribute a whole field that rank 0 holds, row by row. */
  SlabField scatter_from_root(const SlabLayoutPtr       &layout,
                              const std::vector<double> &whole);

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
    for (int w = 0; w < static_cast<int>(layout->windows().size()); ++w)
      {
        const ZoomWindow &window = layout->windows()[w];
        std::size_t       k      = layout->start_of_window(w);
        for (int iy = 0; iy < window.n_rows(); ++iy)
          for (int ix = 0; ix < window.n_columns(); ++ix)
            {
              const auto [x, y] = layout->position(w, ix, iy);
              field[k++]        = height(x, y);
            }
      }
    return field;
  }
} // namespace strait

#endif
