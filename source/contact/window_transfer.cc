// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/window_transfer.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /**
     * Call visit(fine, coarse, weight) for each point of a window's line and each point
     * that it depends on, of the parent's line of @p n points and its rim. The middle one
     * of three is a point of the parent; the others lie a third of the spacing before and
     * after that, with mirrored weights.
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
    patch.assign(static_cast<std::size_t>(n_columns) * patch_rows(), Number(0));
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

  /** Call visit(position in the patch, position among the values of this rank). */
  template <class Number>
  template <class Visit>
  void
  WindowTransfer<Number>::for_each_of_patch(const SlabLayout &layout,
                                            const int         window,
                                            const Visit      &visit) const
  {
    constexpr int margin = ZoomWindow::margin;
    layout.for_each_around(
      window, margin, [&](const int a, const int b, const std::size_t at) {
        visit(static_cast<std::size_t>(b + margin) * patch_columns() + a + margin, at);
      });
  }

  template <class Number>
  std::vector<Number>
  WindowTransfer<Number>::patch_of(const SlabLayout &layout,
                                   const int         window,
                                   const Number     *values) const
  {
    std::vector<Number> patch(static_cast<std::size_t>(patch_columns()) * patch_rows());
    for_each_of_patch(layout, window, [&](const std::size_t k, const std::size_t at) {
      patch[k] = values[at];
    });
    // All ranks hold the windows, but each only its rows of the grid.
    if (layout.windows()[window].parent < 0)
      sum_in_place(layout.communicator(), patch);
    return patch;
  }

  template <class Number>
  void
  WindowTransfer<Number>::add_patch(const SlabLayout          &layout,
                                    const int                  window,
                                    const std::vector<Number> &patch,
                                    Number                    *values) const
  {
    for_each_of_patch(layout, window, [&](const std::size_t k, const std::size_t at) {
      values[at] += patch[k];
    });
  }

  template class WindowTransfer<double>;
  template class WindowTransfer<float>;
} // namespace strait
