// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/grid_deposit.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace strait
{
  namespace
  {
    /** The nodal polynomials of @p degree at @p x. */
    std::vector<double>
    polynomials_at(const unsigned int degree, const double x)
    {
      if (degree == 1)
        return {1. - x, x};
      return {(1. - x) * (1. - 2. * x), 4. * x * (1. - x), x * (2. * x - 1.)};
    }

    /**
     * ∫ φ_k N_n dx over a cell along one axis, for its nodal polynomials φ_k and the
     * hats of the grid points n that it touches, in units of the grid spacing.
     */
    struct Weights
    {
      int                 n = 0;  // number of grid points
      std::vector<double> values; // [k·n + point]
    };

    Weights
    weights(const unsigned int degree, const int exponent, const int index_in_grid_cell)
    {
      const double edge    = std::ldexp(1., exponent); // in grid spacings
      const double origin  = exponent < 0 ? index_in_grid_cell * edge : 0.;
      const int    n_spans = exponent < 0 ? 1 : 1 << exponent;

      Weights result{n_spans + 1, std::vector<double>((degree + 1) * (n_spans + 1))};
      const dealii::QGauss<1> gauss(2);
      const double            length = std::min(edge, 1.);
      for (int span = 0; span < n_spans; ++span)
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double              x      = origin + length * gauss.point(q)[0];
            const double              weight = length * gauss.weight(q);
            const std::vector<double> phi =
              polynomials_at(degree, (span + x - origin) / edge);
            for (unsigned int k = 0; k <= degree; ++k)
              {
                double *of_k = result.values.data() + k * result.n + span;
                of_k[0] += weight * phi[k] * (1. - x);
                of_k[1] += weight * phi[k] * x;
              }
          }
      return result;
    }
  } // namespace

  GridDeposit::GridDeposit(SlabLayoutPtr layout_, const unsigned int degree_)
    : layout(std::move(layout_))
    , degree(degree_)
  {
  }

  void
  GridDeposit::add(const GridCell &cell, const std::vector<double> &values)
  {
    const int     nx = layout->grid().nx, ny = layout->grid().ny;
    const int     parts   = cell.exponent < 0 ? 1 << -cell.exponent : 1;
    const int     first_x = cell.exponent < 0 ? cell.i / parts : cell.i << cell.exponent;
    const int     first_y = cell.exponent < 0 ? cell.j / parts : cell.j << cell.exponent;
    const Weights across  = weights(degree, cell.exponent, cell.i % parts);
    const Weights up      = weights(degree, cell.exponent, cell.j % parts);

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
        Row &target = rows[(first_y + row) % ny];
        target.integral.resize(nx);
        target.area.resize(nx);
        for (int column = 0; column < across.n; ++column)
          {
            double integral = 0, width = 0;
            for (unsigned int k = 0; k < n_nodes; ++k)
              {
                integral += across.values[k * across.n + column] * line[k];
                width += across.values[k * across.n + column];
              }
            const int ix = (first_x + column) % nx;
            target.integral[ix] += integral;
            target.area[ix] += width * area;
          }
      }
  }

  GridDeposit::Sums
  GridDeposit::collect()
  {
    std::vector<int>    touched;
    std::vector<double> integrals, areas;
    for (const auto &[row, values] : rows)
      {
        touched.push_back(row);
        integrals.insert(integrals.end(), values.integral.begin(), values.integral.end());
        areas.insert(areas.end(), values.area.begin(), values.area.end());
      }
    rows.clear();
    Sums sums{SlabField(layout), SlabField(layout)};
    add_rows(*layout, touched, integrals, sums.integral.data());
    add_rows(*layout, touched, areas, sums.area.data());
    return sums;
  }
} // namespace strait
