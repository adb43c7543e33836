// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/analytic_surfaces.h>
#include <strait/surface/sample.h>
#include <strait/surface/scene_text.h>

#include <cmath>

namespace strait
{
  namespace
  {
    const double two_pi = 2 * std::acos(-1.);
    const double sqrt_3 = std::sqrt(3.);
  } // namespace

  SlabField
  FlatSurface::heights(const SlabLayoutPtr &layout) const
  {
    return SlabField(layout);
  }

  SineSurface::SineSurface(const SurfaceParameters &parameters)
    : amplitude(parameters.amplitude)
    , lx(parameters.size[0])
  {
  }

  SlabField
  SineSurface::heights(const SlabLayoutPtr &layout) const
  {
    return sample(layout, [this](const double x, const double) {
      return amplitude * std::cos(two_pi * x / lx);
    });
  }

  SquareSaddleSurface::SquareSaddleSurface(const SurfaceParameters &parameters)
    : amplitude(parameters.amplitude)
    , lx(parameters.size[0])
    , ly(parameters.size[1])
  {
  }

  SlabField
  SquareSaddleSurface::heights(const SlabLayoutPtr &layout) const
  {
    return sample(layout, [this](const double x, const double y) {
      return amplitude * (2 + std::cos(two_pi * x / lx) + std::cos(two_pi * y / ly));
    });
  }

  LatticePeaksSurface::LatticePeaksSurface(const SurfaceParameters &parameters)
    : amplitude(parameters.amplitude)
    , honeycomb(parameters.kind == SurfaceKind::honeycomb_peaks)
    , lx(parameters.size[0])
    , ly(parameters.size[1])
    , long_in_x(lx > ly)
  {
    const double short_side = long_in_x ? ly : lx;
    const double long_side  = long_in_x ? lx : ly;
    if (std::abs(long_side / (sqrt_3 * short_side) - 1) > 1e-6)
      throw InputError(
        "Triangular and honeycomb peaks repeat in a box whose sides are as 1 to "
        "sqrt(3): set Surface/Size = " +
        (long_in_x ? scene_pair(parameters, sqrt_3 * ly, ly)
                   : scene_pair(parameters, lx, sqrt_3 * lx)) +
        ".");
  }

  SlabField
  LatticePeaksSurface::heights(const SlabLayoutPtr &layout) const
  {
    return sample(layout, [this](const double x, const double y) {
      const double along_short = two_pi * (long_in_x ? y / ly : x / lx);
      const double along_long  = two_pi * (long_in_x ? x / lx : y / ly);
      const double waves = std::cos(2 * along_long) + std::cos(along_short + along_long) +
                           std::cos(along_short - along_long);
      return amplitude * (honeycomb ? 3 - waves : 1.5 + waves);
    });
  }

  SphereSurface::SphereSurface(const SurfaceParameters &parameters)
    : radius(parameters.amplitude)
    , lx(parameters.size[0])
    , ly(parameters.size[1])
  {
  }

  SlabField
  SphereSurface::heights(const SlabLayoutPtr &layout) const
  {
    return sample(layout, [this](double x, double y) {
      x -= lx / 2;
      y -= ly / 2;
      return -(x * x + y * y) / (2 * radius);
    });
  }
} // namespace strait
