// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
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
    const Parcels<int> asked = exchange(layout.communicator(), wanted, n_wanted);

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

  template std::vector<double>
  fetch_rows(const SlabLayout &, const double *, int, const std::vector<int> &);
  template std::vector<float>
  fetch_rows(const SlabLayout &, const float *, int, const std::vector<int> &);
  template std::vector<std::int64_t>
  fetch_rows(const SlabLayout &, const std::int64_t *, int, const std::vector<int> &);

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
            // Each row behind its number.
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

  template void add_rows(const SlabLayout &,
                         const std::vector<int> &,
                         const std::vector<float> &,
                         float *);
  template void add_rows(const SlabLayout &,
                         const std::vector<int> &,
                         const std::vector<double> &,
                         double *);

  std::vector<double>
  gather_on_root(const SlabField &field)
  {
    std::vector<int> rows(field.layout().rank() == 0 ? field.grid().ny : 0);
    std::iota(rows.begin(), rows.end(), 0);
    return fetch_rows(field, rows);
  }

  SlabField
  scatter_from_root(const SlabLayoutPtr &layout, const std::vector<double> &whole)
  {
    std::vector<int> n_rows(layout->n_ranks());
    if (layout->rank() == 0)
      for (int rank = 0; rank < layout->n_ranks(); ++rank)
        n_rows[rank] = layout->first_row_of(rank + 1) - layout->first_row_of(rank);
    const std::vector<double> rows =
      exchange(layout->communicator(), whole, n_rows, layout->grid().nx).items;
    SlabField field(layout);
    std::copy(rows.begin(), rows.end(), field.begin());
    return field;
  }
} // namespace strait
