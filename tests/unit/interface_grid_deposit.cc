// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/interface/grid_deposit.h>

#include <gtest/gtest.h>

#include <cmath>

namespace strait
{
  namespace
  {
    constexpr int side = 16;

    /** Cells of several sizes that fill the grid, those of this rank only. */
    std::vector<GridCell>
    own_cells(const SlabLayout &layout)
    {
      std::vector<GridCell> all = {{3, 0, 0}, {3, 1, 0}, {3, 0, 1}};
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          if (i < 3 || j < 3)
            all.push_back({1, 4 + i, 4 + j});
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i)
          all.push_back({-2, 56 + i, 56 + j}); // a quarter of a spacing
      std::vector<GridCell> own;
      for (std::size_t c = 0; c < all.size(); ++c)
        if (static_cast<int>(c) % layout.n_ranks() == layout.rank())
          own.push_back(all[c]);
      return own;
    }

    /** Nodal values on @p cell of a function of the grid's index coordinates. */
    template <class Function>
    std::vector<double>
    values_on(const GridCell &cell, const unsigned int degree, const Function &f)
    {
      const double        edge = std::ldexp(1., cell.exponent);
      std::vector<double> values;
      for (unsigned int l = 0; l <= degree; ++l)
        for (unsigned int k = 0; k <= degree; ++k)
          values.push_back(f(edge * (cell.i + static_cast<double>(k) / degree),
                             edge * (cell.j + static_cast<double>(l) / degree)));
      return values;
    }

    class GridDepositTest : public testing::TestWithParam<unsigned int>
    {
    };

    TEST_P(GridDepositTest, LosesNothing)
    {
      const SlabLayoutPtr layout =
        make_layout(PeriodicGrid{side, side, 1., 1.}, MPI_COMM_WORLD);
      const auto f = [](const double x, const double y) {
        return 1 + .3 * x - .1 * x * y;
      };
      GridDeposit deposit(layout, GetParam());
      for (const GridCell &cell : own_cells(*layout))
        deposit.add(cell, values_on(cell, GetParam(), f));
      const GridDeposit::Sums sums = deposit.collect();
      const double            all  = side * side;
      // ∫ f over [0, side]² in units of grid cells
      const double exact = all + .3 * .5 * side * all - .1 * .25 * all * all;
      EXPECT_NEAR(mean(sums.integral) * all / exact, 1., 1e-14);
      for (const double area : sums.area)
        EXPECT_NEAR(area, 1., 1e-14);
    }

    TEST_P(GridDepositTest, IsTheTransposeOfInterpolation)
    {
      // Σ_i v_i ∫ f N_i = ∫ f v for the bilinear interpolant v of x on one cell.
      const SlabLayoutPtr layout =
        make_layout(PeriodicGrid{side, side, 1., 1.}, MPI_COMM_WORLD);
      const GridCell cell = {2, 1, 2}; // [4, 8] × [8, 12]
      GridDeposit    deposit(layout, GetParam());
      if (layout->rank() == 0)
        deposit.add(cell,
                    values_on(cell, GetParam(), [](double x, double) { return x; }));
      const SlabField integral = deposit.collect().integral;
      double          local    = 0;
      for (int row = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < side; ++ix)
          local += ix * integral(ix, row);
      EXPECT_NEAR(sum(MPI_COMM_WORLD, local), 4. * (512. - 64.) / 3., 1e-11);
    }

    INSTANTIATE_TEST_SUITE_P(Degrees, GridDepositTest, testing::Values(1U, 2U));
  } // namespace
} // namespace strait
