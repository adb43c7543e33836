// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_layout.h>

#include <array>
#include <vector>

namespace strait
{
  /**
   * Between a window and the patch of its parent that it covers, with a rim of
   * ZoomWindow::margin points around it: interpolation by polynomials through the eight
   * nearest points each way, and its adjoint. @p Number is double or float.
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

    /** The window's values from those of @p patch. */
    void interpolate(const std::vector<Number> &patch, Number *window);

    /** The parent's pressure that stands for that of @p window: the adjoint of
     *  interpolate(), over the nine of the window's points to one of the parent's. */
    void deposit(const Number *window, std::vector<Number> &patch);

    /** The patch around window @p window of @p layout, this transfer's, from the values
     * of all points. Collective if the parent is the grid. */
    std::vector<Number>
    patch_of(const SlabLayout &layout, int window, const Number *values) const;

    /** Add what is on @p patch to the values of its points; of the grid, those of this
     *  rank. */
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
    std::array<Number, n_support> weights; // of the points around, a third away from one
    std::vector<Number>           between; // the window's rows, the patch's columns
  };
} // namespace strait
