// SPDX-License-Identifier: GPL-2.0-or-later
// Grids with windows, and fields on them that depend on the position alone.
#pragma once

#include <strait/spectral/slab_field.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace window_tests
{
  using namespace strait;

  using Height = std::function<double(double, double)>;

  inline SlabLayoutPtr
  layout_with(const int n, const std::vector<ZoomWindow> &windows)
  {
    return with_windows(*make_layout({n, n, 1., 1.}, MPI_COMM_WORLD), windows);
  }

  inline ZoomWindow
  window_at(const int x, const int y, const int nx, const int ny)
  {
    return {-1, 1, x, y, nx, ny};
  }

  /** Return the windows with x and y exchanged. */
  inline std::vector<ZoomWindow>
  transposed(std::vector<ZoomWindow> windows)
  {
    for (ZoomWindow &window : windows)
      {
        std::swap(window.x, window.y);
        std::swap(window.nx, window.ny);
      }
    return windows;
  }

  /** Return a pseudo-random number in [0, 1) from @p seed and the position alone. */
  inline double
  noise(const std::uint64_t seed, const int x, const int y)
  {
    std::uint64_t state = seed * 0x9E3779B97F4A7C15ULL + x * 0xD1B54A32D192ED03ULL +
                          y * 0x8CB92BA72F3D8DD7ULL;
    for (int round = 0; round < 3; ++round)
      {
        state ^= state >> 29;
        state *= 0xBF58476D1CE4E5B9ULL;
      }
    return static_cast<double>(state >> 11) * 0x1p-53;
  }

  /** Return the position of a point of window @p w (−1: of the grid) in ninths of the
   *  grid spacing, within the box. */
  inline std::pair<int, int>
  place_of(const SlabLayout &layout, const int w, const int ix, const int iy)
  {
    const int n        = 9 * layout.grid().nx;
    const auto [x, y]  = layout.position(w, ix, iy);
    const auto in_nine = [n](const double position) {
      return (static_cast<int>(std::lround(position * n)) + n) % n;
    };
    return {in_nine(x), in_nine(y)};
  }

  /** Return a field of noise that is the same at points of all levels that coincide. */
  inline SlabField
  noise_field(const SlabLayoutPtr &layout, const std::uint64_t seed)
  {
    const int n = 9 * layout->grid().nx;
    return sample(layout, [=](const double x, const double y) {
      return noise(seed,
                   (static_cast<int>(std::lround(x * n)) + n) % n,
                   (static_cast<int>(std::lround(y * n)) + n) % n);
    });
  }

  /** Return random heights: a sum of waves, up to four per side of the box. */
  inline Height
  rough(const std::uint64_t seed)
  {
    return [seed](const double x, const double y) {
      double value = 0.;
      for (int qx = 0; qx <= 4; ++qx)
        for (int qy = -4; qy <= 4; ++qy)
          value += (noise(seed, qx, qy) - .5) *
                   std::cos(2 * M_PI * (qx * x + qy * y + noise(seed + 99, qx, qy)));
      return value;
    };
  }
} // namespace window_tests
