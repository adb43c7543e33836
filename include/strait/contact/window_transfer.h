// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_layout.h>

#include <array>
#include <vector>

namespace strait
{
  /**
   * Interpolation from a patch of the parent to a window, by polynomials through the
   * eight nearest points each way, and its adjoint. The patch is what the window covers
   * and a rim of ZoomWindow::margin points around that. @p Number is double or float.
   */
  template <class Number>
  class WindowTransfer
  {
  public:
    explicit WindowTransfer(const ZoomWindow &window);

    /** Columns and rows of the patch. */
    int
    patch_columns() const
    {
      return nx + 2 * ZoomWindow::margin;
    }

    int
    patch_rows() const
    {
      return ny + 2 * ZoomWindow::margin;
    }

    /** Compute the values at the points of @p window from those of @p patch. */
    void interpolate(const std::vector<Number> &patch, Number *window);

    /** Compute the pressure on @p patch that stands for that of @p window: the adjoint of
     *  interpolate(), over nine, the number of window points per point of the parent. */
    void deposit(const Number *window, std::vector<Number> &patch);

    /** Return the patch of window @p window of @p layout, for which this transfer was
     *  made, from the @p values of all points. Collective if the parent is the grid. */
    std::vector<Number>
    patch_of(const SlabLayout &layout, int window, const Number *values) const;

    /** Add @p patch to the @p values at its points; of the grid, to local ones. */
    void add_patch(const SlabLayout          &layout,
                   int                        window,
                   const std::vector<Number> &patch,
                   Number                    *values) const;

  private:
    template <class Visit>
    void
    for_each_of_patch(const SlabLayout &layout, int window, const Visit &visit) const;

    static constexpr int n_support = 2 * ZoomWindow::margin;

    int                           nx, ny;
    std::array<Number, n_support> weights; // at a third of the spacing after a point
    std::vector<Number>           between; // scratch: window rows × patch columns
  };
} // namespace strait
