// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace strait
{
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

    /** What this rank sends to all others or gets from them, one rank after the other. */
    template <class Number>
    struct Parcels
    {
      std::vector<Number> numbers;
      std::vector<int>    counts; // of units, for each rank
    };

    /** Collective: what all ranks have for this one. Numbers are sent in units of
     *  @p unit, so that counts stay small. */
    template <class Number>
    Parcels<Number>
    exchange(MPI_Comm comm, const Parcels<Number> &sent, const int unit)
    {
      const std::size_t n_ranks = sent.counts.size();
      Parcels<Number>   received{{}, std::vector<int>(n_ranks)};
      MPI_Alltoall(
        sent.counts.data(), 1, MPI_INT, received.counts.data(), 1, MPI_INT, comm);
      std::vector<int> to(n_ranks + 1), from(n_ranks + 1);
      std::partial_sum(sent.counts.begin(), sent.counts.end(), to.begin() + 1);
      std::partial_sum(received.counts.begin(), received.counts.end(), from.begin() + 1);
      received.numbers.resize(static_cast<std::size_t>(from.back()) * unit);
      MPI_Datatype type;
      MPI_Type_contiguous(unit * static_cast<int>(sizeof(Number)), MPI_BYTE, &type);
      MPI_Type_commit(&type);
      MPI_Alltoallv(sent.numbers.data(),
                    sent.counts.data(),
                    to.data(),
                    type,
                    received.numbers.data(),
                    received.counts.data(),
                    from.data(),
                    type,
                    comm);
      MPI_Type_free(&type);
      return received;
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
    const int                ny = layout.grid().ny;
    std::vector<std::size_t> order(rows.size()); // by owner
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto wrapped = [&](const std::size_t k) { return ((rows[k] % ny) + ny) % ny; };
    const auto owner   = [&](const std::size_t k) {
      return layout.owner_of_row(wrapped(k));
    };
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const std::size_t a, const std::size_t b) {
                       return owner(a) < owner(b);
                     });
    Parcels<int> wanted{{}, std::vector<int>(layout.n_ranks())};
    for (const std::size_t k : order)
      {
        wanted.numbers.push_back(wrapped(k));
        ++wanted.counts[owner(k)];
      }
    const Parcels<int> asked = exchange(layout.communicator(), wanted, 1);

    const auto      length = static_cast<std::size_t>(row_length);
    Parcels<Number> outgoing{std::vector<Number>(asked.numbers.size() * length),
                             asked.counts};
    for (std::size_t k = 0; k < asked.numbers.size(); ++k)
      std::copy_n(local_rows + (asked.numbers[k] - layout.first_row()) * length,
                  length,
                  outgoing.numbers.data() + k * length);
    const Parcels<Number> incoming =
      exchange(layout.communicator(), outgoing, row_length);

    std::vector<Number> result(incoming.numbers.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      std::copy_n(incoming.numbers.data() + k * length,
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

  void
  add_rows(const SlabLayout          &layout,
           const std::vector<int>    &rows,
           const std::vector<double> &values,
           double                    *local_rows)
  {
    const int       nx = layout.grid().nx;
    Parcels<double> outgoing{{}, std::vector<int>(layout.n_ranks())};
    for (int rank = 0; rank < layout.n_ranks(); ++rank)
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (const int row = rows[k] % layout.grid().ny; layout.owner_of_row(row) == rank)
          {
            // Each row behind its number.
            outgoing.numbers.push_back(row);
            outgoing.numbers.insert(outgoing.numbers.end(),
                                    &values[k * nx],
                                    &values[k * nx] + nx);
            ++outgoing.counts[rank];
          }
    const std::vector<double> incoming =
      exchange(layout.communicator(), outgoing, nx + 1).numbers;
    for (std::size_t at = 0; at < incoming.size(); at += nx + 1)
      {
        const auto row = static_cast<std::size_t>(incoming[at]) - layout.first_row();
        for (int i = 0; i < nx; ++i)
          local_rows[row * nx + i] += incoming[at + 1 + i];
      }
  }

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
