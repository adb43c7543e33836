// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/slab_field.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace
{
  using namespace strait;

  /** A field whose value at each point is the global number of the point. */
  SlabField
  numbered(const SlabLayoutPtr &layout)
  {
    SlabField field(layout);
    for (std::size_t i = 0; i < field.size(); ++i)
      field[i] = static_cast<double>(i) +
                 static_cast<double>(layout->first_row()) * layout->grid().nx;
    return field;
  }

  TEST(SlabLayout, RowsAreDealtOutOnce)
  {
    for (const int ny : {1, 2, 3, 4, 7, 64})
      {
        const SlabLayoutPtr layout = make_layout({5, ny, 1., 1.}, MPI_COMM_WORLD);
        EXPECT_EQ(layout->first_row_of(0), 0);
        EXPECT_EQ(layout->first_row_of(layout->n_ranks()), ny);
        for (int row = 0; row < ny; ++row)
          {
            const int owner = layout->owner_of_row(row);
            EXPECT_GE(row, layout->first_row_of(owner));
            EXPECT_LT(row, layout->first_row_of(owner + 1));
          }
        EXPECT_EQ(layout->n_local_points(), 5U * layout->n_rows());
      }
  }

  TEST(SlabField, Reductions)
  {
    const SlabField field = numbered(make_layout({6, 4, 1., 1.}, MPI_COMM_WORLD));
    EXPECT_DOUBLE_EQ(mean(field), 11.5);
    EXPECT_DOUBLE_EQ(rms(field), std::sqrt((24. * 24. - 1) / 12));
    EXPECT_EQ(min_value(field), 0.);
    EXPECT_EQ(max_value(field), 23.);
  }

  TEST(SlabField, FetchedRowsWrapAroundAndKeepTheirOrder)
  {
    const int           nx = 3, ny = 7;
    const SlabLayoutPtr layout = make_layout({nx, ny, 1., 1.}, MPI_COMM_WORLD);
    const SlabField     field  = numbered(layout);
    // Ranks ask for different rows, for some of them twice, and rank 2 for none.
    std::vector<int> rows = {6, -1, 0, 7, 13, 3, 3, -8};
    if (layout->rank() == 1)
      rows = {4};
    if (layout->rank() == 2)
      rows.clear();
    const std::vector<double> values = fetch_rows(field, rows);
    ASSERT_EQ(values.size(), rows.size() * nx);
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (int ix = 0; ix < nx; ++ix)
        EXPECT_EQ(values[k * nx + ix], ((rows[k] + 2 * ny) % ny) * nx + ix);
  }

  TEST(SlabField, FetchedRowsOfAnyLength)
  {
    const SlabLayoutPtr layout = make_layout({4, 5, 1., 1.}, MPI_COMM_WORLD);
    std::vector<double> pairs;
    for (int row = 0; row < layout->n_rows(); ++row)
      {
        pairs.push_back(layout->first_row() + row);
        pairs.push_back(-1. - layout->first_row() - row);
      }
    const std::vector<double> fetched = fetch_rows(*layout, pairs.data(), 2, {4, 0, 5});
    EXPECT_EQ(fetched, (std::vector<double>{4, -5, 0, -1, 0, -1}));
  }

  TEST(SlabField, GatherAndScatterAreInverse)
  {
    for (const int ny : {1, 2, 5, 8})
      {
        const SlabLayoutPtr       layout = make_layout({3, ny, 1., 1.}, MPI_COMM_WORLD);
        const SlabField           field  = numbered(layout);
        const std::vector<double> whole  = gather_on_root(field);
        if (layout->rank() == 0)
          {
            std::vector<double> expected(3 * ny);
            std::iota(expected.begin(), expected.end(), 0.);
            EXPECT_EQ(whole, expected);
          }
        else
          EXPECT_TRUE(whole.empty());
        const SlabField back = scatter_from_root(layout, whole);
        for (std::size_t i = 0; i < field.size(); ++i)
          EXPECT_EQ(back[i], field[i]);
      }
  }
} // namespace
