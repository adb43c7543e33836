// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/two_scale_operator.h>
#include <strait/contact/wave_response.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** The stencil with these symbols for a uniform field and the shortest waves. */
    NinePointStencil
    stencil_through(const double uniform,
                    const double along_x,
                    const double along_y,
                    const double along_both)
    {
      return {(uniform + along_x + along_y + along_both) / 4,
              (uniform - along_x + along_y - along_both) / 8,
              (uniform + along_x - along_y - along_both) / 8,
              (uniform - along_x - along_y + along_both) / 16};
    }
  } // namespace

  double
  NinePointStencil::symbol(const double phase_x, const double phase_y) const
  {
    const double cx = std::cos(phase_x), cy = std::cos(phase_y);
    return centre + 2 * (x * cx + y * cy) + 4 * diagonal * cx * cy;
  }

  TwoScaleOperator
  TwoScaleOperator::stiffness(const SlabLayoutPtr &points,
                              const SlabLayoutPtr &boxes,
                              const double         contact_modulus)
  {
    const auto of_wave = wave_stiffness(points->grid(), contact_modulus);
    // The weight is 4 because the adjoint of the mean gives each point of a box a
    // quarter.
    return {points, boxes, of_wave, std::min(of_wave(1, 0), of_wave(0, 1)), 0., 4.};
  }

  TwoScaleOperator
  TwoScaleOperator::compliance(const SlabLayoutPtr &points,
                               const SlabLayoutPtr &boxes,
                               const double         contact_modulus,
                               const double         uniform)
  {
    // The stencil treats a uniform field as a wave of 2π points: with twice this value
    // the sum is up to 1.7 times the compliance, with half of it down to 0.75 times.
    const double spacing = std::sqrt(points->grid().dx() * points->grid().dy());
    // The weight is 1/4 because the adjoint of the interpolation sums over four points.
    return {points,
            boxes,
            wave_compliance<double>(points->grid(), contact_modulus),
            uniform,
            2 * spacing / contact_modulus,
            .25};
  }

  TwoScaleOperator::TwoScaleOperator(const SlabLayoutPtr &points,
                                     const SlabLayoutPtr &boxes,
                                     const Answer        &answer,
                                     const double         uniform,
                                     const double         of_stencil,
                                     const double         weight)
    : layout(points)
    , transform(boxes)
  {
    const PeriodicGrid &grid = points->grid();
    const double kx_most = grid.nx / 2., ky_most = grid.ny / 2.; // of the shortest waves
    stencil = stencil_through(of_stencil,
                              answer(kx_most, 0),
                              answer(0, ky_most),
                              answer(kx_most, ky_most));
    for (int ky = 0; 2 * ky <= boxes->grid().ny; ++ky)
      for (int kx = 0; 2 * kx <= boxes->grid().nx; ++kx)
        {
          const double wanted = kx + ky > 0 ? answer(kx, ky) : uniform;
          const double lacking =
            wanted - stencil.symbol(2 * M_PI / grid.nx * kx, 2 * M_PI / grid.ny * ky);
          box_symbol.push_back(static_cast<float>(weight * std::max(0., lacking)));
        }
  }

  void
  TwoScaleOperator::on_points(float *values) const
  {
    const int        nx = layout->grid().nx, n_rows = layout->n_rows();
    std::vector<int> outside;
    if (n_rows > 0)
      outside = {layout->first_row() - 1, layout->first_row() + n_rows};
    const std::vector<float> beyond = fetch_rows(*layout, values, nx, outside);
    // The original values of the row above, then of this one; and the part of the stencil
    // beside the centre, with its periodic images.
    std::vector<float> above(beyond.begin(), beyond.begin() + (n_rows > 0 ? nx : 0)),
      mixed(nx + 2);
    const auto centre = static_cast<float>(stencil.centre),
               side_x = static_cast<float>(stencil.x),
               side_y = static_cast<float>(stencil.y),
               corner = static_cast<float>(stencil.diagonal);
    for (int row = 0; row < n_rows; ++row)
      {
        float       *here  = values + static_cast<std::size_t>(row) * nx;
        const float *below = row + 1 < n_rows ? here + nx : beyond.data() + nx;
        float       *up = above.data(), *side = mixed.data() + 1;
        for (int i = 0; i < nx; ++i)
          {
            const float vertical = up[i] + below[i];
            up[i]                = here[i];
            side[i]              = side_x * up[i] + corner * vertical;
            here[i]              = centre * up[i] + side_y * vertical;
          }
        side[-1] = side[nx - 1];
        side[nx] = side[0];
        for (int i = 0; i < nx; ++i)
          here[i] += side[i - 1] + side[i + 1];
      }
  }

  void
  TwoScaleOperator::on_boxes(float *values)
  {
    const int n_waves = transform.layout().grid().nx / 2 + 1;
    transform.multiply(values, values, [this, n_waves](const int kx, const int ky) {
      return box_symbol[ky * n_waves + kx];
    });
  }
} // namespace strait
