// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/pyramid_extension.h>

#include <algorithm>
#include <cstdint>

namespace strait
{
  PyramidExtension::PyramidExtension(const SlabLayoutPtr &layout_)
    : layout(layout_)
  {
    levels.push_back(std::make_unique<GridBoxes>(layout));
    const auto smallest_side = [&]() {
      const PeriodicGrid &grid = levels.back()->layout->grid();
      return std::min(grid.nx, grid.ny);
    };
    while (smallest_side() > 4)
      levels.push_back(std::make_unique<GridBoxes>(levels.back()->layout));
  }

  template <class Has>
  void
  PyramidExtension::apply(
    float                                                       *values,
    const Has                                                   *has,
    const RowPass                                               &before,
    const std::function<void(const RowPass &, const RowPass &)> &act,
    const RowPass                                               &after)
  {
    GridBoxes &finest = *levels.front();
    const auto nx     = static_cast<std::size_t>(layout->grid().nx);
    finest.clear_values();
    finest.clear_sums();
    for (int row = 0; row < layout->n_rows(); ++row)
      {
        before(row);
        finest.add_row(row, values + row * nx, has + row * nx);
      }
    extend();
    const RowPass begin = [&](const int row) {
      finest.interpolate(row, values + row * nx, has + row * nx);
    };
    const RowPass end = [&](const int row) {
      if (row == 0)
        finest.clear_values();
      finest.interpolate_adjoint(row, values + row * nx, has + row * nx);
    };
    act(begin, end);
    extend_adjoint();
    for (int row = 0; row < layout->n_rows(); ++row)
      {
        finest.add_boxes(row, values + row * nx, has + row * nx);
        after(row);
      }
  }

  /** From what the finest boxes were given to the values that are interpolated from. */
  void
  PyramidExtension::extend()
  {
    for (std::size_t l = 0; l < levels.size(); ++l)
      {
        GridBoxes &boxes = *levels[l];
        if (l > 0)
          {
            boxes.clear_values();
            boxes.clear_sums();
            levels[l - 1]->for_each_row(
              [&](const int row, const float *values, const float *sums) {
                boxes.add_row(row, values, sums);
              });
          }
        boxes.take_means();
      }
    levels.back()->weigh();
    for (std::size_t l = levels.size(); l-- > 0;)
      {
        GridBoxes &boxes = *levels[l];
        boxes.fetch();
        if (l > 0)
          levels[l - 1]->for_each_row(
            [&](const int row, float *values, const float *sums) {
              boxes.interpolate(row, values, sums);
            });
      }
  }

  void
  PyramidExtension::extend_adjoint()
  {
    for (std::size_t l = 0; l < levels.size(); ++l)
      {
        GridBoxes &boxes = *levels[l];
        if (l > 0)
          {
            boxes.clear_values();
            levels[l - 1]->for_each_row(
              [&](const int row, float *values, const float *sums) {
                boxes.interpolate_adjoint(row, values, sums);
              });
          }
        boxes.send();
      }
    levels.back()->weigh();
    for (std::size_t l = levels.size(); l-- > 0;)
      {
        GridBoxes &boxes = *levels[l];
        boxes.divide();
        boxes.fetch();
        if (l > 0)
          levels[l - 1]->for_each_row(
            [&](const int row, float *values, const float *sums) {
              boxes.add_boxes(row, values, sums);
            });
      }
  }

  template void
  PyramidExtension::apply(float *,
                          const std::uint8_t *,
                          const RowPass &,
                          const std::function<void(const RowPass &, const RowPass &)> &,
                          const RowPass &);
  template void
  PyramidExtension::apply(float *,
                          const float *,
                          const RowPass &,
                          const std::function<void(const RowPass &, const RowPass &)> &,
                          const RowPass &);
} // namespace strait
