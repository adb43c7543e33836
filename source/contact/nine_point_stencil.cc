// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/two_scale_operator.h>

#include <array>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Solve the positive definite 4 × 4 system A x = b by elimination. */
    std::array<double, 4>
    solve(std::array<std::array<double, 4>, 4> a, std::array<double, 4> b)
    {
      for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 4; ++i)
          if (i != k)
            {
              const double factor = a[i][k] / a[k][k];
              for (int j = k; j < 4; ++j)
                a[i][j] -= factor * a[k][j];
              b[i] -= factor * b[k];
            }
      return {{b[0] / a[0][0], b[1] / a[1][1], b[2] / a[2][2], b[3] / a[3][3]}};
    }
  } // namespace

  double
  NinePointStencil::symbol(const double phase_x, const double phase_y) const
  {
    const double cx = std::cos(phase_x), cy = std::cos(phase_y);
    return centre + 2 * (x * cx + y * cy) + 4 * diagonal * cx * cy;
  }

  NinePointStencil
  fit_stencil(const std::function<double(double, double)> &target)
  {
    // Sample points of the fit along each axis. The target is smooth but at the origin:
    // half and double of it change the stencil little, and its making is cheap.
    constexpr int                        n = 128;
    std::array<std::array<double, 4>, 4> normal{};
    std::array<double, 4>                right{};
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        {
          const double                x = M_PI * i / n, y = M_PI * j / n;
          const double                wanted = target(x, y);
          const std::array<double, 4> basis  = {
             {1., 2 * std::cos(x), 2 * std::cos(y), 4 * std::cos(x) * std::cos(y)}};
          const double weight =
            (i % n == 0 ? 0.5 : 1.) * (j % n == 0 ? 0.5 : 1.) / (wanted * wanted);
          for (int k = 0; k < 4; ++k)
            {
              right[k] += weight * basis[k] * wanted;
              for (int l = 0; l < 4; ++l)
                normal[k][l] += weight * basis[k] * basis[l];
            }
        }
    const std::array<double, 4> c = solve(normal, right);
    return {c[0], c[1], c[2], c[3]};
  }
} // namespace strait
