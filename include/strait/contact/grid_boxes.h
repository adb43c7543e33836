// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_layout.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace strait
{
  /** A number for each box of 2 × 2 points of a grid, on the rank that owns the box and
   *  on the ranks with points in or next to it. */
  class BoxField
  {
  public:
    /** @p boxes is the layout of the boxes, @p points that of the points. */
    BoxField(SlabLayoutPtr boxes, const SlabLayout &points);

    /** The numbers of row @p number of the boxes, taken modulo the number of rows. */
    float *row(int number);

    void clear();

    /** Clear only the local copies of other ranks' rows. */
    void clear_others();

    /** Add the local copies of other ranks' rows to the originals. Collective. */
    void send();

    /** Update the local copies of other ranks' rows. Collective. */
    void fetch();

    std::vector<float> own; // the numbers of this rank's boxes

  private:
    const SlabLayoutPtr    layout;
    const std::vector<int> other_rows;
    std::vector<float>     beyond; // the numbers of these rows
  };

  /**
   * Weighted means over the boxes of 2 × 2 points of a grid, linear interpolation between
   * the boxes, and the adjoints of both. Where a side has an odd number of points the
   * last boxes are half as wide.
   *
   * In all functions @p weights gives the weights of the points of a row: marks (1 or 0)
   * or, if the points are boxes of a finer level, the sums of the weights in them.
   */
  class GridBoxes
  {
  public:
    /** A box has the weight 1 from this sum of its points' weights on. With 2 or 4 the
     *  contact takes a few more iterations. */
    static constexpr float full = 3;

    /** The weight of a point with this mark. */
    static float
    weight_of(const std::uint8_t mark)
    {
      return mark ? 1.f : 0.f;
    }

    /** The weight of a box with this sum of its points' weights. */
    static float
    weight_of(const float sum)
    {
      return std::min(1.f, sum / full);
    }

    explicit GridBoxes(const SlabLayoutPtr &points);

    /** Add the weighted values @p points of the local row @p row, and the weights, to the
     *  sums of the boxes. */
    template <class Weights>
    void
    add_row(const int row, const float *points, const Weights *weights)
    {
      float *value = values.row((first_row + row) / 2);
      float *sum   = sums.row((first_row + row) / 2);
      for_each_box([&](const int i, const auto... of) {
        value[i] += (... + (weight_of(weights[of]) * points[of]));
        sum[i] += (... + weight_of(weights[of]));
      });
    }

    /** Divide the values by the sums of the weights; boxes without weight get 0. */
    void divide();

    /** Multiply the values by their weights, for the coarsest level: as if the rest were
     *  interpolated from zeros. */
    void weigh();

    /** Let a point of the weight w keep this part of its value, and fill up the rest by
     *  interpolation between the boxes. */
    template <class Weights>
    void
    interpolate(const int row, float *points, const Weights *weights)
    {
      const auto [here, beside] = rows_at(row);
      float *const at           = line.data() + 1;
      for (int i = 0; i < n; ++i)
        at[i] = .75f * here[i] + .25f * beside[i];
      at[-1] = at[n - 1];
      at[n]  = at[0];

      const auto set = [=](const int i, const float value) {
        const float weight = weight_of(weights[i]);
        points[i]          = weight * points[i] + (1 - weight) * value;
      };
      for_each_box([&](const int i, const int even, const auto... odd) {
        set(even, .75f * at[i] + .25f * at[i - 1]);
        (..., set(odd, .75f * at[i] + .25f * at[i + 1]));
      });
    }

    /** The adjoint of interpolate(). */
    template <class Weights>
    void
    interpolate_adjoint(const int row, float *points, const Weights *weights)
    {
      const auto take = [=](const int i) {
        const float value = points[i], kept = weight_of(weights[i]) * value;
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
    template <class Weights>
    void
    add_boxes(const int row, float *points, const Weights *weights)
    {
      const float *value = values.row((first_row + row) / 2);
      for_each_box([&](const int i, const auto... of) {
        (..., (points[of] += weight_of(weights[of]) * value[i]));
      });
    }

    /** Call visit(row, values, sums of weights) for each row of this rank's boxes. */
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
    /** Call visit(box, its points...) for the boxes along a row of points. */
    template <class Visit>
    void
    for_each_box(const Visit &visit) const
    {
      for (int i = 0; i < n_columns / 2; ++i)
        visit(i, 2 * i, 2 * i + 1);
      if (n_columns % 2 == 1)
        visit(n - 1, n_columns - 1);
    }

    /** The values of the row of boxes that contains local row @p row of the points, and
     *  those of the next nearest row of boxes. */
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
