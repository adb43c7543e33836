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
  template std::vector<std::int64_t>
  fetch_rows(const SlabLayout &, const std::int64_t *, int, const std::vector<int> &);

  void
  add_rows(const SlabLayout          &layout,
           const std::vector<int>    &rows,
           const std::vector<double> &values,
           double                    *local_rows)
  {
    const int           n_ranks = layout.n_ranks(), nx = layout.grid().nx;
    std::vector<int>    sent(n_ranks), received(n_ranks), from(n_ranks), to(n_ranks);
    std::vector<double> outgoing; // each row behind its number
    for (int rank = 0; rank < n_ranks; ++rank)
      {
        to[rank] = static_cast<int>(outgoing.size());
        for (std::size_t k = 0; k < rows.size(); ++k)
          if (const int row = rows[k] % layout.grid().ny;
              layout.owner_of_row(row) == rank)
            {
              outgoing.push_back(row);
              outgoing.insert(outgoing.end(), &values[k * nx], &values[k * nx] + nx);
            }
        sent[rank] = static_cast<int>(outgoing.size()) - to[rank];
      }
    MPI_Comm comm = layout.communicator();
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm);
    std::partial_sum(received.begin(), received.end() - 1, from.begin() + 1);
    std::vector<double> incoming(from.back() + received.back());
    MPI_Alltoallv(outgoing.data(),
                  sent.data(),
                  to.data(),
                  MPI_DOUBLE,
                  incoming.data(),
                  received.data(),
                  from.data(),
                  MPI_DOUBLE,
                  comm);
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
