// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/seal/harmonic_extension.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace strait
{
  namespace
  {
    /** Of −weight (f(i−1) − 2 f(i) + f(i+1)) on waves of 0 … n/2 periods in n points. */
    std::vector<double>
    second_difference(const int n, const double weight)
    {
      std::vector<double> result(n / 2 + 1);
      for (std::size_t k = 0; k < result.size(); ++k)
        {
          const double s = std::sin(M_PI * static_cast<double>(k) / n);
          result[k]      = 4. * weight * s * s;
        }
      return result;
    }
  } // namespace

  HarmonicExtension::HarmonicExtension(SlabLayoutPtr       layout_,
                                       const FlowDirection direction_)
    : layout(std::move(layout_))
    , direction(direction_)
    , weight_x(layout->grid().dy() / layout->grid().dx())
    , weight_y(layout->grid().dx() / layout->grid().dy())
    , stiffness_x(second_difference(layout->grid().nx, weight_x))
    , stiffness_y(second_difference(layout->grid().ny, weight_y))
    , transform(layout)
  {
  }

  bool
  HarmonicExtension::is_on_seam(const int ix, const int local_row) const
  {
    return direction == FlowDirection::x ? ix == 0 : layout->first_row() + local_row == 0;
  }

  void
  HarmonicExtension::classify(const SlabField &flow_gap)
  {
    const int        nx = layout->grid().nx, n_rows = layout->n_rows();
    const RowsAround rows(flow_gap);

    // Strong springs make a point stiff: scaled to their own stiffness all are alike.
    const double own = 2. * (weight_x + weight_y);
    spring.resize(layout->n_local_points());
    softness.resize(spring.size());
    waves.resize(spring.size());
    for (int row = 0, k = 0; row < n_rows; ++row)
      for (int ix = 0; ix < nx; ++ix, ++k)
        {
          double largest = 0;
          for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a)
              largest = std::max(largest, rows[row + b][(ix + a + nx) % nx]);
          // A point is open with half of the largest gap beside it.
          const double ratio =
            largest > 0 ? 2. * std::max(flow_gap[k], 0.) / largest : 0.;
          spring[k]   = ratio < 1 && !is_on_seam(ix, row)
                          ? (weight_x + weight_y) * ratio * ratio / (1. - ratio)
                          : std::numeric_limits<double>::infinity();
          softness[k] = static_cast<float>(1. / std::sqrt(1. + spring[k] / own));
        }
  }

  int
  HarmonicExtension::extend(SlabField       &pressure,
                            const SlabField &flow_gap,
                            const double     inlet_pressure,
                            const double     outlet_pressure,
                            const double     reduction)
  {
    // Of the boundary values' own residual. Half and double of it take an iteration more
    // or less; single precision would not tell them apart.
    constexpr double tolerance = 1e-7;
    // It only ends what would go on for ever: half of it would be enough where the
    // preconditioner works, double of it fails later.
    constexpr int max_iterations = 1000;
    classify(flow_gap);

    // Boundary values and springs alone, which are the right-hand side.
    SlabField boundary_values(layout), load(layout);
    for (int row = 0, k = 0; row < layout->n_rows(); ++row)
      for (int ix = 0; ix < layout->grid().nx; ++ix, ++k)
        {
          if (is_on_seam(ix, row))
            pressure[k] = .5 * (inlet_pressure + outlet_pressure);
          if (std::isinf(spring[k]))
            boundary_values[k] = pressure[k];
          else
            load[k] = spring[k] * pressure[k];
        }

    SlabField r(layout), z(layout), t(layout), q(layout);
    apply(boundary_values, inlet_pressure, outlet_pressure, r);
    for (std::size_t k = 0; k < r.size(); ++k)
      r[k] -= load[k];
    const double enough = tolerance * std::sqrt(product(r, r));
    if (!(enough > 0))
      {
        // No pressure anywhere at the edge of the contact, hence none under it.
        pressure = boundary_values;
        return 0;
      }
    apply(pressure, inlet_pressure, outlet_pressure, r);
    for (std::size_t k = 0; k < r.size(); ++k)
      r[k] = load[k] - r[k];

    const double goal = std::max(enough, reduction * std::sqrt(product(r, r)));

    double last_rz   = 0;
    int    iteration = 0;
    while (std::sqrt(product(r, r)) > goal && iteration < max_iterations)
      {
        precondition(r, z);
        const double rz   = product(r, z);
        const double beta = iteration == 0 ? 0. : rz / last_rz;
        for (std::size_t k = 0; k < t.size(); ++k)
          t[k] = z[k] + beta * t[k];
        apply(t, 0., 0., q);
        const double alpha = rz / product(t, q);
        for (std::size_t k = 0; k < t.size(); ++k)
          {
            pressure[k] += alpha * t[k];
            r[k] -= alpha * q[k];
          }
        last_rz = rz;
        ++iteration;
      }
    return iteration;
  }

  void
  HarmonicExtension::apply(const SlabField &values,
                           const double     inlet,
                           const double     outlet,
                           SlabField       &result)
  {
    const int        nx = layout->grid().nx, ny = layout->grid().ny;
    const int        begin = layout->first_row(), n_rows = layout->n_rows();
    const bool       along_x = direction == FlowDirection::x;
    const RowsAround rows(values);
    for (int row = 0; row < n_rows; ++row)
      {
        const double *here = rows[row], *below = rows[row - 1], *above = rows[row + 1];
        const int     iy = begin + row;
        for (int ix = 0; ix < nx; ++ix)
          {
            const std::size_t k = static_cast<std::size_t>(row) * nx + ix;
            result[k]           = 0;
            if (std::isinf(spring[k]))
              continue;
            const double left =
              along_x && ix == 1 ? inlet : here[ix == 0 ? nx - 1 : ix - 1];
            const double right =
              along_x && ix == nx - 1 ? outlet : here[ix == nx - 1 ? 0 : ix + 1];
            const double lower = !along_x && iy == 1 ? inlet : below[ix];
            const double upper = !along_x && iy == ny - 1 ? outlet : above[ix];
            result[k] = spring[k] * here[ix] + weight_x * (2. * here[ix] - left - right) +
                        weight_y * (2. * here[ix] - lower - upper);
          }
      }
  }

  void
  HarmonicExtension::precondition(const SlabField &r, SlabField &z)
  {
    for (std::size_t k = 0; k < waves.size(); ++k)
      waves[k] = softness[k] * static_cast<float>(r[k]);
    // The pressure is held all around a contact, which is hardly wider than a tenth of
    // the box: longer waves are no less stiff than that one. Half and double of it
    // precondition waves worse that are as long as the contacts, or as short, and change
    // the number of iterations only.
    constexpr double periods = 10.;
    const double     least = periods * periods * std::min(stiffness_x[1], stiffness_y[1]);
    transform.multiply(waves.data(), waves.data(), [&](const int kx, const int ky) {
      return 1. / (least + stiffness_x[std::abs(kx)] + stiffness_y[std::abs(ky)]);
    });
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = softness[k] * waves[k];
  }
} // namespace strait
