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

  template <class Weights>
  void
  PyramidExtension::gather(const float *values, const Weights *weights)
  {
    finest().values.clear();
    for (const auto &boxes : levels)
      boxes->sums.clear();
    pass_points(values, weights, &GridBoxes::add_row<Weights>);
    climb(&GridBoxes::add_row<float>, [](GridBoxes &boxes) {
      boxes.values.send();
      boxes.sums.send();
      boxes.divide();
    });
    finest().values.clear_others();
  }

  template <class Weights>
  void
  PyramidExtension::spread(float *values, const Weights *weights)
  {
    descend([](GridBoxes &boxes) { boxes.values.fetch(); },
            &GridBoxes::interpolate<float>);
    pass_points(values, weights, &GridBoxes::interpolate<Weights>);
    finest().values.clear_others();
  }

  template <class Weights>
  void
  PyramidExtension::extend_adjoint(float *values, const Weights *weights)
  {
    pass_points(values, weights, &GridBoxes::interpolate_adjoint<Weights>);
    climb(&GridBoxes::interpolate_adjoint<float>,
          [](GridBoxes &boxes) { boxes.values.send(); });
    descend(
      [](GridBoxes &boxes) {
        boxes.divide();
        boxes.values.fetch();
      },
      &GridBoxes::add_boxes<float>);
    pass_points(values, weights, &GridBoxes::add_boxes<Weights>);
  }

  /** From fine to coarse, let each level take the finer level's boxes by add(row, values,
   *  weights), and then finish(). */
  template <class Add, class Finish>
  void
  PyramidExtension::climb(const Add &add, const Finish &finish)
  {
    for (std::size_t l = 0; l < levels.size(); ++l)
      {
        if (l > 0)
          {
            levels[l]->values.clear();
            pass_rows(l, add);
          }
        finish(*levels[l]);
      }
  }

  /** From coarse to fine, let each level prepare() and then change the finer level's
   *  boxes by give(row, values, weights). */
  template <class Prepare, class Give>
  void
  PyramidExtension::descend(const Prepare &prepare, const Give &give)
  {
    levels.back()->weigh();
    for (std::size_t l = levels.size(); l-- > 0;)
      {
        prepare(*levels[l]);
        if (l > 0)
          pass_rows(l, give);
      }
  }

  /** Hand the local rows of boxes of the next finer level to level @p l. */
  template <class Pass>
  void
  PyramidExtension::pass_rows(const std::size_t l, const Pass &pass)
  {
    GridBoxes &boxes = *levels[l];
    levels[l - 1]->for_each_row([&](const int row, float *values, const float *sums) {
      (boxes.*pass)(row, values, sums);
    });
  }

  /** Hand the local rows of the points to the finest level. */
  template <class Numbers, class Weights, class Pass>
  void
  PyramidExtension::pass_points(Numbers *values, const Weights *weights, const Pass &pass)
  {
    const auto nx = static_cast<std::size_t>(layout->grid().nx);
    for (int row = 0; row < layout->n_rows(); ++row)
      (finest().*pass)(row, values + row * nx, weights + row * nx);
  }

  template void PyramidExtension::gather(const float *, const std::uint8_t *);
  template void PyramidExtension::gather(const float *, const float *);
  template void PyramidExtension::spread(float *, const std::uint8_t *);
  template void PyramidExtension::spread(float *, const float *);
  template void PyramidExtension::extend_adjoint(float *, const std::uint8_t *);
  template void PyramidExtension::extend_adjoint(float *, const float *);
} // namespace strait
