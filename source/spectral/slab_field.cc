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
