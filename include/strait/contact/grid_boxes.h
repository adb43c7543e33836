// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_layout.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace strait
{
  /** A number for each box of 2 × 2 points of a grid, on the rank that has the box and on
   *  those with points beside it. */
  class BoxField
  {
  public:
    /** @p boxes is the grid of boxes, @p points that of points. */
    BoxField(SlabLayoutPtr boxes, const SlabLayout &points);

    /** Those of a row of the grid, which counts modulo the number of rows. */
    float *row(int number);

    void clear();

    /** Of the rows of other ranks. */
    void clear_others();

    /** Send what was added on other ranks' rows to these ranks. Collective. */
    void send();

    /** Get the rows of other ranks. Collective. */
    void fetch();

    std::vector<float> own; // of the boxes of this rank

  private:
    const SlabLayoutPtr    layout;
    const std::vector<int> other_rows;
    std::vector<float>     beyond; // of those rows
  };

  /**
   * Weighted means over the boxes of 2 × 2 points of a grid, interpolation between them,
   * and the adjoints of both. Where a side has an odd number of points the last boxes are
   * half as wide.
   *
   * Points are weighed by marks (1 or 0) or, if they are boxes themselves, by the sum of
   * the weights in them: @p has.
   */
  class GridBoxes
  {
  public:
    /** Boxes whose points have this much weight count in full. With 2 or 4 the contact
     * takes a few iterations more. */
    static constexpr float full = 3;

    /** The weight of a point by its mark. */
    static float
    weight_of(const std::uint8_t mark)
    {
      return mark ? 1.f : 0.f;
    }

    /** The weight of a box by the sum of those of its points. */
    static float
    weight_of(const float sum)
    {
      return std::min(1.f, sum / full);
    }

    explicit GridBoxes(const SlabLayoutPtr &points);

    /** Add the local row @p row of points to the boxes, with weights by what @p has says
     *  of each. */
    template <class Has>
    void
    add_row(const int row, const float *points, const Has *has)
    {
      float *value = values.row((first_row + row) / 2);
      float *sum   = sums.row((first_row + row) / 2);
      for_each_box([&](const int i, const auto... of) {
        value[i] += (... + (weight_of(has[of]) * points[of]));
        sum[i] += (... + weight_of(has[of]));
      });
    }

    /** By the sums of the weights; boxes without weight get 0. */
    void divide();

    /** Of the coarsest level: as if interpolated from zeros. */
    void weigh();

    /** Give points what their weights leave open, linear between the boxes. */
    template <class Has>
    void
    interpolate(const int row, float *points, const Has *has)
    {
      const auto [here, beside] = rows_at(row);
      float *const at           = line.data() + 1;
      for (int i = 0; i < n; ++i)
        at[i] = .75f * here[i] + .25f * beside[i];
      at[-1] = at[n - 1];
      at[n]  = at[0];

      const auto set = [=](const int i, const float value) {
        const float weight = weight_of(has[i]);
        points[i]          = weight * points[i] + (1 - weight) * value;
      };
      for_each_box([&](const int i, const int even, const auto... odd) {
        set(even, .75f * at[i] + .25f * at[i - 1]);
        (..., set(odd, .75f * at[i] + .25f * at[i + 1]));
      });
    }

    /** The adjoint of interpolate(). */
    template <class Has>
    void
    interpolate_adjoint(const int row, float *points, const Has *has)
    {
      const auto take = [=](const int i) {
        const float value = points[i], kept = weight_of(has[i]) * value;
        points[i] = kept;
        return value - kept;
      };
      float *const to_left = line.data() + 1, *const to_right = other_line.data() + 1;
      for_each_box([&](const int i, const int even, const auto... odd) {
        to_left[i]  = take(even);
        to_right[i] = (0.f + ... + take(odd));
      });
      to_left[n]   = to_left[0];
      to_right[-1] = to_right[n - 1];

      const auto [here, beside] = rows_at(row);
      for (int i = 0; i < n; ++i)
        {
          const float value =
            .75f * (to_left[i] + to_right[i]) + .25f * (to_left[i + 1] + to_right[i - 1]);
          here[i] += .75f * value;
          beside[i] += .25f * value;
        }
    }

    /** The adjoint of add_row(). */
    template <class Has>
    void
    add_boxes(const int row, float *points, const Has *has)
    {
      const float *value = values.row((first_row + row) / 2);
      for_each_box([&](const int i, const auto... of) {
        (..., (points[of] += weight_of(has[of]) * value[i]));
      });
    }

    /** visit(row, values, sums of weights) for the boxes of this rank. */
    template <class Visit>
    void
    for_each_row(const Visit &visit)
    {
      for (int row = 0; row < layout->n_rows(); ++row)
        {
          const std::size_t at = static_cast<std::size_t>(row) * n;
          visit(row, values.own.data() + at, sums.own.data() + at);
        }
    }

    const SlabLayoutPtr layout; // of the boxes
    BoxField            values, sums;

  private:
    /** visit(box, its points along a row). */
    template <class Visit>
    void
    for_each_box(const Visit &visit) const
    {
      for (int i = 0; i < n_columns / 2; ++i)
        visit(i, 2 * i, 2 * i + 1);
      if (n_columns % 2 == 1)
        visit(n - 1, n_columns - 1);
    }

    /** Values of the boxes of a row of points and of those beside it. */
    std::array<float *, 2>
    rows_at(const int row)
    {
      const int here = (first_row + row) / 2;
      return {
        {values.row(here), values.row(here + ((first_row + row) % 2 == 1 ? 1 : -1))}};
    }

    const int          n_columns;        // of the points
    const int          first_row;        // of those of this rank
    const int          n;                // columns of boxes
    std::vector<float> line, other_line; // scratch
  };
} // namespace strait
