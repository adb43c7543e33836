// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/grid_deposit.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace strait
{
  GridDeposit::GridDeposit(SlabLayoutPtr layout_, const unsigned int degree_)
    : layout(std::move(layout_))
    , degree(degree_)
  {
  }

  std::vector<double>
  GridDeposit::polynomials_at(const double x) const
  {
    if (degree == 1)
      return {1. - x, x};
    return {(1. - x) * (1. - 2. * x), 4. * x * (1. - x), x * (2. * x - 1.)};
  }

  GridDeposit::Weights
  GridDeposit::compute_weights(const int exponent, const int index_in_grid_cell) const
  {
    const double edge    = std::ldexp(1., exponent); // in grid spacings
    const double origin  = exponent < 0 ? index_in_grid_cell * edge : 0.;
    const int    n_spans = exponent < 0 ? 1 : 1 << exponent;

    Weights result;
    result.n = n_spans + 1;
    result.values.assign((degree + 1) * result.n, 0.);
    const dealii::QGauss<1> gauss(2);
    const double            length = std::min(edge, 1.);
    for (int span = 0; span < n_spans; ++span)
      for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double              x      = origin + length * gauss.point(q)[0];
          const double              weight = length * gauss.weight(q);
          const std::vector<double> phi    = polynomials_at((span + x - origin) / edge);
          for (unsigned int k = 0; k <= degree; ++k)
            {
              double *of_k = result.values.data() + k * result.n + span;
              of_k[0] += weight * phi[k] * (1. - x);
              of_k[1] += weight * phi[k] * x;
            }
        }
    return result;
  }

  const GridDeposit::Weights &
  GridDeposit::weights(const int exponent, const int index_in_grid_cell)
  {
    const std::pair<int, int> key(exponent, index_in_grid_cell);
    const auto                known = known_weights.find(key);
    if (known != known_weights.end())
      return known->second;
    return known_weights[key] = compute_weights(exponent, index_in_grid_cell);
  }

  void
  GridDeposit::add(const GridCell &cell, const std::vector<double> &values)
  {
    const int      nx = layout->grid().nx, ny = layout->grid().ny;
    const int      parts   = cell.exponent < 0 ? 1 << -cell.exponent : 1;
    const int      first_x = cell.exponent < 0 ? cell.i / parts : cell.i << cell.exponent;
    const int      first_y = cell.exponent < 0 ? cell.j / parts : cell.j << cell.exponent;
    const Weights &across  = weights(cell.exponent, cell.i % parts);
    const Weights &up      = weights(cell.exponent, cell.j % parts);

    const unsigned int  n_nodes = degree + 1;
    std::vector<double> line(n_nodes);
    for (int row = 0; row < up.n; ++row)
      {
        // The function and the constant 1, integrated along y.
        double area = 0;
        for (unsigned int k = 0; k < n_nodes; ++k)
          {
            line[k] = 0;
            for (unsigned int l = 0; l < n_nodes; ++l)
              line[k] += up.values[l * up.n + row] * values[l * n_nodes + k];
            area += up.values[k * up.n + row];
          }
        std::vector<double> &target = rows[(first_y + row) % ny];
        target.resize(2 * static_cast<std::size_t>(nx));
        for (int column = 0; column < across.n; ++column)
          {
            double integral = 0, width = 0;
            for (unsigned int k = 0; k < n_nodes; ++k)
              {
                integral += across.values[k * across.n + column] * line[k];
                width += across.values[k * across.n + column];
              }
            double *here = target.data() + 2 * ((first_x + column) % nx);
            here[0] += integral;
            here[1] += width * area;
          }
      }
  }

  GridDeposit::Sums
  GridDeposit::collect()
  {
    const std::size_t n_row = 2 * static_cast<std::size_t>(layout->grid().nx);
    // Rows by their owner, each as its number and its values.
    std::map<unsigned int, std::vector<double>> parcels;
    for (const auto &[row, values] : rows)
      {
        auto &parcel = parcels[static_cast<unsigned int>(layout->owner_of_row(row))];
        parcel.push_back(row);
        parcel.insert(parcel.end(), values.begin(), values.end());
      }
    rows.clear();

    Sums       sums{SlabField(layout), SlabField(layout)};
    const auto unpack = [&](const std::vector<double> &parcel) {
      for (std::size_t start = 0; start < parcel.size(); start += n_row + 1)
        {
          const int     row    = static_cast<int>(parcel[start]) - layout->first_row();
          const double *values = parcel.data() + start + 1;
          for (int ix = 0; ix < layout->grid().nx; ++ix)
            {
              sums.integral(ix, row) += values[2 * ix];
              sums.area(ix, row) += values[2 * ix + 1];
            }
        }
    };
    if (layout->n_ranks() == 1)
      unpack(parcels[0]);
    else
      for (const auto &[rank, parcel] :
           dealii::Utilities::MPI::some_to_some(layout->communicator(), parcels))
        unpack(parcel);
    return sums;
  }
} // namespace strait
