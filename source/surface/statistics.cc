// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/statistics.h>

#include <array>
#include <cmath>

namespace strait
{
  SurfaceStatistics
  statistics(const SlabField &height)
  {
    const PeriodicGrid &grid = height.grid();

    std::array<double, 2> sums{}; // of q² |h~|² and (qx⁴ + qy⁴) |h~|²
    FourierTransform      transform(height.layout_pointer());
    transform.analyze(height.data(),
                      [&](const int                   kx,
                          const int                   ky,
                          const std::complex<double> &mode,
                          const double                weight) {
                        const double qx_squared = std::pow(2 * M_PI * kx / grid.lx, 2);
                        const double qy_squared = std::pow(2 * M_PI * ky / grid.ly, 2);
                        const double power      = weight * std::norm(mode);
                        sums[0] += power * (qx_squared + qy_squared);
                        sums[1] +=
                          power * (qx_squared * qx_squared + qy_squared * qy_squared);
                      });
    sum_in_place(height.layout().communicator(), sums.data(), 2);

    SurfaceStatistics result;
    result.rms_height       = rms(height);
    result.rms_slope        = std::sqrt(sums[0]);
    result.rms_curvature    = std::sqrt(sums[1] / 2);
    result.curvature_radius = 1 / result.rms_curvature;
    result.highest          = max_value(height);
    result.lowest           = min_value(height);
    return result;
  }
} // namespace strait
