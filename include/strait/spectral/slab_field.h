// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/spectral/slab_layout.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <vector>

namespace strait
{
  /**
   * One real number per grid point, in slabs: this rank holds its rows one
   * after the other, x fastest, without padding. The values of the layout's windows
   * follow, the same on all ranks.
   */
  class SlabField : private std::vector<double>
  {
  public:
    // Access to the local values, including those of windows.
    using std::vector<double>::begin;
    using std::vector<double>::end;
    using std::vector<double>::data;
    using std::vector<double>::size;
    using std::vector<double>::operator[];

    SlabField() = default;

    explicit SlabField(SlabLayoutPtr layout, const double value = 0.)
      : std::vector<double>(layout->n_values(), value)
      , slab_layout(std::move(layout))
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

    /** Value at column @p ix of the local row @p local_row. */
    double &
    operator()(const int ix, const int local_row)
    {
      return (*this)[static_cast<std::size_t>(local_row) * grid().nx + ix];
    }

    double
    operator()(const int ix, const int local_row) const
    {
      return (*this)[static_cast<std::size_t>(local_row) * grid().nx + ix];
    }

  private:
    SlabLayoutPtr slab_layout;
  };

  /** Mean over the box of @p function of the values. Collective. */
  template <class Function>
  double
  mean_of(const SlabField &field, const Function &function)
  {
    double total = 0;
    for (const SlabLayout::Range &range : field.layout().ranges())
      {
        double part = 0;
        for (std::size_t k = range.begin; k < range.end; ++k)
          part += function(field[k]);
        total += range.area * part;
      }
    return sum(field.layout().communicator(), total) / field.grid().n_points();
  }

  /** Mean over the box. Collective. */
  double mean(const SlabField &field);

  /** Root mean square about the mean. Collective. */
  double rms(const SlabField &field);

  /** Σ a[k] b[k] for k < @p n, in double precision. */
  template <typename Number>
  double
  local_product(const Number *a, const Number *b, const std::size_t n)
  {
    // With a single sum each addition would wait for the one before.
    double            sums[8]    = {};
    const std::size_t n_together = n - n % std::size(sums);
    for (std::size_t k = 0; k < n_together; k += std::size(sums))
      for (std::size_t j = 0; j < std::size(sums); ++j)
        sums[j] += static_cast<double>(a[k + j]) * b[k + j];
    for (std::size_t k = n_together; k < n; ++k)
      sums[0] += static_cast<double>(a[k]) * b[k];
    return std::accumulate(std::begin(sums), std::end(sums), 0.);
  }

  /** Σ a b over the points of @p layout, each weighted by the area that it stands for
   *  over that of a grid point. The values may be any that are arranged like this
   *  layout's. Collective. */
  template <typename Values>
  double
  product(const SlabLayout &layout, const Values &a, const Values &b)
  {
    double total = 0.;
    for (const SlabLayout::Range &range : layout.ranges())
      total += range.area * local_product(a.data() + range.begin,
                                          b.data() + range.begin,
                                          range.end - range.begin);
    return sum(layout.communicator(), total);
  }

  /** The same of fields. Collective. */
  inline double
  product(const SlabField &a, const SlabField &b)
  {
    return product(a.layout(), a, b);
  }

  /** Smallest value. Collective. */
  double min_value(const SlabField &field);

  /** Largest value. Collective. */
  double max_value(const SlabField &field);

  /** Return the rows @p rows of the grid (global numbers, any order, taken modulo ny) of
   *  @p field, one after the other. Each rank may ask for other rows. Collective. */
  std::vector<double> fetch_rows(const SlabField &field, const std::vector<int> &rows);

  /** The same for any array of @p row_length numbers per row, arranged like @p layout. */
  template <class Number>
  std::vector<Number>
  fetch_rows(const SlabLayout       &layout,
             const Number           *local_rows,
             const int               row_length,
             const std::vector<int> &rows)
  {
    const int                ny = layout.grid().ny;
    std::vector<std::size_t> order(rows.size()); // by number, and thus by owner
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto wrapped = [&](const std::size_t k) { return ((rows[k] % ny) + ny) % ny; };
    std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
      return wrapped(a) < wrapped(b);
    });
    std::vector<int> wanted, n_wanted(layout.n_ranks());
    for (const std::size_t k : order)
      {
        wanted.push_back(wrapped(k));
        ++n_wanted[layout.owner_of_row(wrapped(k))];
      }
    const ReceivedItems<int> asked = exchange(layout.communicator(), wanted, n_wanted);

    const auto          length = static_cast<std::size_t>(row_length);
    std::vector<Number> outgoing(asked.items.size() * length);
    for (std::size_t k = 0; k < asked.items.size(); ++k)
      std::copy_n(local_rows + (asked.items[k] - layout.first_row()) * length,
                  length,
                  outgoing.data() + k * length);
    const std::vector<Number> incoming =
      exchange(layout.communicator(), outgoing, asked.counts, row_length).items;

    std::vector<Number> result(incoming.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      std::copy_n(incoming.data() + k * length,
                  length,
                  result.data() + order[k] * length);
    return result;
  }

  /** The adjoint of fetch_rows(): add row k of @p values to the row rows[k] >= 0, taken
   *  modulo ny, in the @p local_rows of the rank that owns it, one rank after the other.
   *  Collective. */
  template <class Number>
  void
  add_rows(const SlabLayout          &layout,
           const std::vector<int>    &rows,
           const std::vector<Number> &values,
           Number                    *local_rows)
  {
    const int           nx = layout.grid().nx;
    std::vector<Number> outgoing;
    std::vector<int>    n_outgoing(layout.n_ranks());
    for (int rank = 0; rank < layout.n_ranks(); ++rank)
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (const int row = rows[k] % layout.grid().ny; layout.owner_of_row(row) == rank)
          {
            // Each row follows its number.
            outgoing.push_back(static_cast<Number>(row));
            outgoing.insert(outgoing.end(), &values[k * nx], &values[k * nx] + nx);
            ++n_outgoing[rank];
          }
    const std::vector<Number> incoming =
      exchange(layout.communicator(), outgoing, n_outgoing, nx + 1).items;
    for (std::size_t at = 0; at < incoming.size(); at += nx + 1)
      {
        const auto row = static_cast<std::size_t>(incoming[at]) - layout.first_row();
        for (int i = 0; i < nx; ++i)
          local_rows[row * nx + i] += incoming[at + 1 + i];
      }
  }

  /** Return the whole grid of a field on rank 0 (empty elsewhere), row by row.
   *  Collective. */
  std::vector<double> gather_on_root(const SlabField &field);

  /** Distribute a whole field that rank 0 holds, row by row. Collective. */
  SlabField scatter_from_root(const SlabLayoutPtr       &layout,
                              const std::vector<double> &whole);

  /** The field height(x, y) at the points of this rank; no communication. */
  template <class Height>
  SlabField
  sample(const SlabLayoutPtr &layout, const Height &height)
  {
    SlabField field(layout);
    double   *next = field.data();
    layout->for_each_point([&](const GridPoint &point) {
      const auto [x, y] = layout->position(point.window, point.ix, point.iy);
      *next++           = height(x, y);
    });
    return field;
  }

  /** This rank's rows of a field, with `reach` rows before and after them, and its
   *  windows. */
  class RowsAround
  {
  public:
    /** @p field must outlive this object. Collective. */
    explicit RowsAround(const SlabField &field_, const int reach_ = 1)
      : field(field_)
      , reach(reach_)
    {
      const int        first = field.layout().first_row();
      const int        end   = first + field.layout().n_rows();
      std::vector<int> wanted;
      for (int k = 0; end > first && k < 2 * reach; ++k)
        wanted.push_back(k < reach ? first - reach + k : end - reach + k);
      neighbours = fetch_rows(field, wanted);
    }

    /** Row @p row, counted from this rank's first: −reach <= @p row < n_rows + reach. */
    const double *
    operator[](const int row) const
    {
      const int            n_rows = field.layout().n_rows();
      const std::ptrdiff_t nx     = field.grid().nx;
      return row < 0         ? neighbours.data() + (row + reach) * nx
             : row >= n_rows ? neighbours.data() + (row - n_rows + reach) * nx
                             : field.data() + row * nx;
    }

    /** The value at a point that is at most `reach` away from one of this rank; NaN
     *  outside of its window. */
    double
    at(const GridPoint &point) const
    {
      const SlabLayout &layout = field.layout();
      const int         nx     = layout.grid().nx;
      if (point.window < 0)
        {
          const int shift = point.ix < 0 ? nx : point.ix < nx ? 0 : -nx;
          return (*this)[point.iy - layout.first_row()][point.ix + shift];
        }
      const ZoomWindow &window = layout.windows()[point.window];
      const bool        exists = point.ix >= 0 && point.ix < window.n_columns() &&
                          point.iy >= 0 && point.iy < window.n_rows();
      return exists ? field[layout.index_of(point)]
                    : std::numeric_limits<double>::quiet_NaN();
    }

  private:
    const SlabField    &field;
    int                 reach;
    std::vector<double> neighbours;
  };
} // namespace strait
