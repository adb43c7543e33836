// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/window_transfer.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /**
     * Call visit(fine, coarse, weight) for the points of a line of @p n points with its
     * rim that a point of the window's line depends on. Half of the window's points lie a
     * third after one of the parent, and half before: mirror images.
     */
    template <class Weights, class Visit>
    void
    for_each_weight(const int n, const Weights &weights, const Visit &visit)
    {
      constexpr int margin = ZoomWindow::margin;
      for (int c = 0; c < n; ++c)
        {
          const int here = c + margin;
          visit(3 * c + 1, here, 1);
          for (int k = 0; k < 2 * margin; ++k)
            {
              const int offset = k - margin + 1;
              visit(3 * c + 2, here + offset, weights[k]);
              visit(3 * c, here - offset, weights[k]);
            }
        }
    }
  } // namespace

  template <class Number>
  WindowTransfer<Number>::WindowTransfer(const ZoomWindow &window)
    : nx(window.nx)
    , ny(window.ny)
    , weights()
    , between(static_cast<std::size_t>(3) * ny * patch_columns())
  {
    for (int k = 0; k < n_support; ++k)
      {
        double weight = 1.;
        for (int other = 0; other < n_support; ++other)
          if (other != k)
            weight *= (1. / 3 - (other - ZoomWindow::margin + 1)) / (k - other);
        weights[k] = static_cast<Number>(weight);
      }
  }

  template <class Number>
  void
  WindowTransfer<Number>::interpolate(const std::vector<Number> &patch, Number *window)
  {
    const int n_columns = patch_columns(), n_fine = 3 * nx;
    std::fill(between.begin(), between.end(), Number(0));
    for_each_weight(ny,
                    weights,
                    [&](const int fine, const int coarse, const Number weight) {
                      const Number *from = patch.data() + coarse * n_columns;
                      Number       *to   = between.data() + fine * n_columns;
                      for (int ix = 0; ix < n_columns; ++ix)
                        to[ix] += weight * from[ix];
                    });
    std::fill_n(window, static_cast<std::size_t>(3) * ny * n_fine, Number(0));
    for (int iy = 0; iy < 3 * ny; ++iy)
      {
        const Number *from = between.data() + iy * n_columns;
        Number       *to   = window + iy * n_fine;
        for_each_weight(nx,
                        weights,
                        [=](const int fine, const int coarse, const Number weight) {
                          to[fine] += weight * from[coarse];
                        });
      }
  }

  template <class Number>
  void
  WindowTransfer<Number>::deposit(const Number *window, std::vector<Number> &patch)
  {
    const int n_columns = patch_columns(), n_fine = 3 * nx;
    std::fill(between.begin(), between.end(), Number(0));
    for (int iy = 0; iy < 3 * ny; ++iy)
      {
        const Number *from = window + iy * n_fine;
        Number       *to   = between.data() + iy * n_columns;
        for_each_weight(nx,
                        weights,
                        [=](const int fine, const int coarse, const Number weight) {
                          to[coarse] += weight * from[fine];
                        });
      }
    std::fill(patch.begin(), patch.end(), Number(0));
    for_each_weight(ny,
                    weights,
                    [&](const int fine, const int coarse, const Number weight) {
                      const Number *from = between.data() + fine * n_columns;
                      Number       *to   = patch.data() + coarse * n_columns;
                      for (int ix = 0; ix < n_columns; ++ix)
                        to[ix] += weight * from[ix];
                    });
    for (Number &value : patch)
      value /= 9;
  }

  template class WindowTransfer<double>;
  template class WindowTransfer<float>;
} // namespace strait
