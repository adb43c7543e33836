// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/grid_boxes.h>
#include <strait/spectral/slab_field.h>

#include <utility>

namespace strait
{
  namespace
  {
    /** The rows of boxes of other ranks in or next to the local rows of @p points. */
    std::vector<int>
    rows_beyond(const SlabLayout &points, const SlabLayout &boxes)
    {
      std::vector<int> rows;
      const int        first = points.first_row(), end = first + points.n_rows();
      const int        n_rows = boxes.grid().ny;
      for (int row = first / 2 - 1; end > first && row <= (end - 1) / 2 + 1; ++row)
        if (const int wrapped = (row + n_rows) % n_rows;
            boxes.owner_of_row(wrapped) != boxes.rank())
          rows.push_back(wrapped);
      return rows;
    }
  } // namespace

  BoxField::BoxField(SlabLayoutPtr boxes, const SlabLayout &points)
    : own(boxes->n_local_points())
    , layout(std::move(boxes))
    , other_rows(rows_beyond(points, *layout))
    , beyond(other_rows.size() * layout->grid().nx)
  {
  }

  float *
  BoxField::row(const int number)
  {
    const int  n_rows = layout->grid().ny, wrapped = (number + n_rows) % n_rows;
    const auto n = static_cast<std::size_t>(layout->grid().nx);
    if (layout->owner_of_row(wrapped) == layout->rank())
      return own.data() + (wrapped - layout->first_row()) * n;
    const auto at = std::find(other_rows.begin(), other_rows.end(), wrapped);
    return beyond.data() + (at - other_rows.begin()) * n;
  }

  void
  BoxField::clear()
  {
    std::fill(own.begin(), own.end(), 0.f);
    clear_others();
  }

  void
  BoxField::clear_others()
  {
    std::fill(beyond.begin(), beyond.end(), 0.f);
  }

  void
  BoxField::send()
  {
    add_rows(*layout, other_rows, beyond, own.data());
  }

  void
  BoxField::fetch()
  {
    beyond = fetch_rows(*layout, own.data(), layout->grid().nx, other_rows);
  }

  GridBoxes::GridBoxes(const SlabLayoutPtr &points)
    : layout(make_layout({(points->grid().nx + 1) / 2,
                          (points->grid().ny + 1) / 2,
                          points->grid().lx,
                          points->grid().ly},
                         points->communicator()))
    , values(layout, *points)
    , sums(layout, *points)
    , n_columns(points->grid().nx)
    , first_row(points->first_row())
    , n(layout->grid().nx)
    , line(n + 2)
    , other_line(n + 2)
  {
  }

  void
  GridBoxes::divide()
  {
    for (std::size_t i = 0; i < values.own.size(); ++i)
      values.own[i] = sums.own[i] > 0 ? values.own[i] / sums.own[i] : 0.f;
  }

  void
  GridBoxes::weigh()
  {
    for (std::size_t i = 0; i < values.own.size(); ++i)
      values.own[i] *= weight_of(sums.own[i]);
  }
} // namespace strait
