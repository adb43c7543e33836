// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  SlabLayout::SlabLayout(const PeriodicGrid     &grid,
                         MPI_Comm                communicator,
                         std::vector<ZoomWindow> windows)
    : periodic_grid(grid)
    , comm(communicator)
    , zoom_windows(std::move(windows))
  {
    MPI_Comm_rank(comm, &my_rank);
    int n_ranks = 1;
    MPI_Comm_size(comm, &n_ranks);

    const int n_most = (grid.ny + n_ranks - 1) / n_ranks;
    for (int r = 0; r <= n_ranks; ++r)
      row_starts.push_back(std::min(r * n_most, grid.ny));

    starts_of_windows.push_back(n_local_points());
    if (zoom_windows.empty())
      own_ranges.push_back({0, n_local_points(), 1.});
    else
      for (int row = 0; row < n_rows(); ++row)
        add_ranges_of_row(-1,
                          first_row() + row,
                          static_cast<std::size_t>(row) * grid.nx,
                          1.);
    for (std::size_t w = 0; w < zoom_windows.size(); ++w)
      {
        const ZoomWindow &window = zoom_windows[w];
        const std::size_t begin  = starts_of_windows.back();
        const double      area   = std::pow(9., -window.level) / n_ranks;
        for (int row = 0; row < window.n_rows(); ++row)
          add_ranges_of_row(static_cast<int>(w),
                            row,
                            begin + static_cast<std::size_t>(row) * window.n_columns(),
                            area);
        starts_of_windows.push_back(begin + static_cast<std::size_t>(window.n_rows()) *
                                              window.n_columns());
      }
  }

  void
  SlabLayout::add_ranges_of_row(const int         window,
                                const int         row,
                                const std::size_t begin,
                                const double      area)
  {
    const int n  = window < 0 ? periodic_grid.nx : zoom_windows[window].n_columns();
    int       ix = 0;
    while (ix < n)
      {
        while (ix < n && covered_by(window, ix, row) >= 0)
          ++ix;
        const int first = ix;
        while (ix < n && covered_by(window, ix, row) < 0)
          ++ix;
        if (ix > first)
          own_ranges.push_back({begin + first, begin + ix, area});
      }
  }

  int
  SlabLayout::covered_by(const int parent, const int ix, const int iy) const
  {
    for (std::size_t w = 0; w < zoom_windows.size(); ++w)
      {
        const ZoomWindow &window = zoom_windows[w];
        if (window.parent != parent)
          continue;
        int a = ix - window.x, b = iy - window.y;
        if (parent < 0)
          {
            a = (a + periodic_grid.nx) % periodic_grid.nx;
            b = (b + periodic_grid.ny) % periodic_grid.ny;
          }
        if (a >= 0 && a < window.nx && b >= 0 && b < window.ny)
          return static_cast<int>(w);
      }
    return -1;
  }

  int
  SlabLayout::seam(const int w, const int axis) const
  {
    const ZoomWindow &window = zoom_windows[w];
    const int         first  = axis == 0 ? window.x : window.y;
    const int         n      = axis == 0 ? window.nx : window.ny;
    int               covered;
    if (window.parent >= 0)
      {
        const int of_parent = seam(window.parent, axis);
        covered             = of_parent < 0 ? -1 : of_parent - first;
      }
    else
      {
        const int n_grid = axis == 0 ? periodic_grid.nx : periodic_grid.ny;
        covered          = (n_grid - first % n_grid) % n_grid;
      }
    return covered >= 0 && covered < n ? 3 * covered + 1 : -1;
  }

  std::array<double, 2>
  SlabLayout::spacing(const int w) const
  {
    const double factor = w < 0 ? 1. : std::pow(3., -zoom_windows[w].level);
    return {periodic_grid.dx() * factor, periodic_grid.dy() * factor};
  }

  std::array<double, 2>
  SlabLayout::position(const int w, const int ix, const int iy) const
  {
    const auto [dx, dy] = spacing(w);
    if (w < 0)
      return {ix * dx, iy * dy};
    const ZoomWindow &window = zoom_windows[w];
    const auto [x, y]        = position(window.parent, window.x, window.y);
    return {x + (ix - 1) * dx, y + (iy - 1) * dy};
  }

  int
  SlabLayout::owner_of_row(const int row) const
  {
    const auto next = std::upper_bound(row_starts.begin(), row_starts.end(), row);
    return static_cast<int>(next - row_starts.begin()) - 1;
  }

  SlabLayoutPtr
  make_layout(const PeriodicGrid &grid, MPI_Comm communicator)
  {
    return std::make_shared<const SlabLayout>(grid, communicator);
  }

  SlabLayoutPtr
  with_windows(const SlabLayout &layout, std::vector<ZoomWindow> windows)
  {
    return std::make_shared<const SlabLayout>(layout.grid(),
                                              layout.communicator(),
                                              std::move(windows));
  }

  namespace
  {
    /** Mean over the box of what @p function makes of the values. Collective. */
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
  } // namespace

  double
  mean(const SlabField &field)
  {
    return mean_of(field, [](const double value) { return value; });
  }

  double
  rms(const SlabField &field)
  {
    const double average = mean(field);
    return std::sqrt(mean_of(field, [average](const double value) {
      return (value - average) * (value - average);
    }));
  }

  double
  min_value(const SlabField &field)
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const double value : field)
      smallest = std::min(smallest, value);
    return minimum(field.layout().communicator(), smallest);
  }

  double
  max_value(const SlabField &field)
  {
    double largest = -std::numeric_limits<double>::infinity();
    for (const double value : field)
      largest = std::max(largest, value);
    return maximum(field.layout().communicator(), largest);
  }

  std::vector<double>
  fetch_rows(const SlabField &field, const std::vector<int> &rows)
  {
    return fetch_rows(field.layout(), field.data(), field.grid().nx, rows);
  }

  template <class Number>
  std::vector<Number>
  fetch_rows(const SlabLayout       &layout,
             const Number           *local_rows,
             const int               row_length,
             const std::vector<int> &rows)
  {
    const int  ny      = layout.grid().ny;
    const int  n_ranks = layout.n_ranks();
    const auto wrap    = [ny](const int row) { return ((row % ny) + ny) % ny; };

    // Tell every owner which of its rows this rank wants.
    std::vector<int> n_wanted(n_ranks, 0), n_asked(n_ranks, 0);
    for (const int row : rows)
      ++n_wanted[layout.owner_of_row(wrap(row))];
    MPI_Alltoall(
      n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, layout.communicator());
    std::vector<int> wanted_at(n_ranks + 1, 0), asked_at(n_ranks + 1, 0);
    for (int r = 0; r < n_ranks; ++r)
      {
        wanted_at[r + 1] = wanted_at[r] + n_wanted[r];
        asked_at[r + 1]  = asked_at[r] + n_asked[r];
      }
    std::vector<int> wanted(rows.size()), place(rows.size());
    std::vector<int> next(wanted_at.begin(), wanted_at.end() - 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        const int row      = wrap(rows[k]);
        const int position = next[layout.owner_of_row(row)]++;
        wanted[position]   = row;
        place[k]           = position;
      }
    std::vector<int> asked(asked_at[n_ranks]);
    MPI_Alltoallv(wanted.data(),
                  n_wanted.data(),
                  wanted_at.data(),
                  MPI_INT,
                  asked.data(),
                  n_asked.data(),
                  asked_at.data(),
                  MPI_INT,
                  layout.communicator());

    // Send the rows as units of one contiguous type, so that counts stay small.
    MPI_Datatype row_type;
    MPI_Type_contiguous(row_length * static_cast<int>(sizeof(Number)),
                        MPI_BYTE,
                        &row_type);
    MPI_Type_commit(&row_type);
    std::vector<Number> outgoing(asked.size() * static_cast<std::size_t>(row_length));
    std::vector<Number> incoming(rows.size() * static_cast<std::size_t>(row_length));
    for (std::size_t k = 0; k < asked.size(); ++k)
      std::copy_n(local_rows +
                    static_cast<std::size_t>(asked[k] - layout.first_row()) * row_length,
                  row_length,
                  outgoing.data() + k * row_length);
    MPI_Alltoallv(outgoing.data(),
                  n_asked.data(),
                  asked_at.data(),
                  row_type,
                  incoming.data(),
                  n_wanted.data(),
                  wanted_at.data(),
                  row_type,
                  layout.communicator());
    MPI_Type_free(&row_type);

    std::vector<Number> result(incoming.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      std::copy_n(incoming.data() + static_cast<std::size_t>(place[k]) * row_length,
                  row_length,
                  result.data() + k * row_length);
    return result;
  }

  template std::vector<double>
  fetch_rows(const SlabLayout &, const double *, int, const std::vector<int> &);
  template std::vector<float>
  fetch_rows(const SlabLayout &, const float *, int, const std::vector<int> &);

  std::vector<double>
  gather_on_root(const SlabField &field)
  {
    std::vector<int> rows;
    if (field.layout().rank() == 0)
      for (int row = 0; row < field.grid().ny; ++row)
        rows.push_back(row);
    return fetch_rows(field, rows);
  }

  SlabField
  scatter_from_root(const SlabLayoutPtr &layout, const std::vector<double> &whole)
  {
    SlabField        field(layout);
    std::vector<int> counts(layout->n_ranks()), starts(layout->n_ranks());
    for (int r = 0; r < layout->n_ranks(); ++r)
      {
        starts[r] = layout->first_row_of(r);
        counts[r] = layout->first_row_of(r + 1) - starts[r];
      }
    MPI_Datatype row_type;
    MPI_Type_contiguous(layout->grid().nx, MPI_DOUBLE, &row_type);
    MPI_Type_commit(&row_type);
    MPI_Scatterv(whole.data(),
                 counts.data(),
                 starts.data(),
                 row_type,
                 field.data(),
                 layout->n_rows(),
                 row_type,
                 0,
                 layout->communicator());
    MPI_Type_free(&row_type);
    return field;
  }
} // namespace strait
