// SPDX-License-Identifier: GPL-2.0-or-later
// The moments of a gap on a grid with windows are those on a grid as fine as the window.
#include <strait/interface/gap_field.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace strait
{
  namespace
  {
    constexpr int    n  = 24;
    constexpr double lx = 2., ly = 1.;

    /** A periodic gap, closed in places unless it is @p raised. */
    double
    gap_at(const double x, const double y, const double raised = 0.)
    {
      return raised + .2 +
             .5 * std::cos(2 * M_PI * (x / lx - .1)) * std::cos(2 * M_PI * y / ly) +
             .1 * std::sin(4 * M_PI * (x / lx + y / ly));
    }

    SlabField
    on_grid(const int factor)
    {
      return sample(make_layout({factor * n, factor * n, lx, ly}, MPI_COMM_WORLD),
                    [](const double x, const double y) { return gap_at(x, y); });
    }

    SlabField
    on_grid_with(const std::vector<ZoomWindow> &windows, const double raised = 0.)
    {
      const SlabLayoutPtr grid = make_layout({n, n, lx, ly}, MPI_COMM_WORLD);
      return sample(with_windows(*grid, windows),
                    [=](const double x, const double y) { return gap_at(x, y, raised); });
    }

    // A window across the seam of the grid, another one beside it, and one in the first.
    const std::vector<ZoomWindow> windows = {{-1, 1, 5, 18, 10, 11},
                                             {-1, 1, 17, 3, 4, 5},
                                             {0, 2, 6, 7, 15, 12}};

    /** Whether the first window covers all corners of cell (@p i, @p j) of the grid. */
    bool
    is_in_first(const int i, const int j)
    {
      const int b = (j - windows[0].y + n) % n;
      return i >= windows[0].x && i + 1 < windows[0].x + windows[0].nx &&
             b + 1 < windows[0].ny;
    }

    bool
    is_in_second(const int i, const int j)
    {
      return i >= 17 && i + 1 < 21 && j >= 3 && j + 1 < 8;
    }

    bool
    is_in_third(const int i, const int j)
    {
      // It covers columns 6 … 20 and rows 7 … 18 of the first window, of which every
      // third, from 1 on, belongs to the grid: columns 7 … 19 and rows 7 … 16.
      return i >= 5 + 2 && i + 1 <= 5 + 6 && j >= 18 + 2 && j + 1 <= 18 + 5;
    }

    using Coefficient = GapField::Coefficient;

    class GapFieldLevels : public testing::TestWithParam<FluidParameters>
    {
    protected:
      GapField
      field_of(const SlabField &gap) const
      {
        GapField field(gap.layout_pointer(), GetParam());
        field.update(gap, 1e-3 * field.conductivity_of(.1));
        return field;
      }

      /** Return the moments of @p cell of the coarse grid, summed up from those of the
       *  cells of @p finer, whose grid is @p factor times as fine. */
      static std::vector<double>
      sum_up(const GapField   &finer,
             const int         factor,
             const Coefficient coefficient,
             const GridCell   &cell)
      {
        std::vector<GridCell> parts;
        for (int b = 0; b < factor; ++b)
          for (int a = 0; a < factor; ++a)
            parts.push_back({cell.exponent, factor * cell.i + a, factor * cell.j + b});
        const CellMoments   answers = finer.moments_on(coefficient, parts);
        const MomentSet    &set     = finer.moment_set();
        std::vector<double> result(set.size());
        const double        edge = 1. / factor;
        for (int k = 0; k < factor * factor; ++k)
          set.add_part(result.data(),
                       &answers(k, 0),
                       edge * (k % factor),
                       edge * (k / factor), // NOLINT: the row
                       edge);
        return result;
      }
    };

    TEST_P(GapFieldLevels, AreThoseOfTheFinestLevelInEachCellOfTheGrid)
    {
      const GapField levels = field_of(on_grid_with(windows)),
                     coarse = field_of(on_grid(1)), fine = field_of(on_grid(3)),
                     finest = field_of(on_grid(9));
      int n_compared[3]     = {0, 0, 0};
      for (const Coefficient coefficient :
           {Coefficient::conductivity, Coefficient::resistivity})
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            {
              const GridCell cell{0, i, j};
              const bool     is_third  = is_in_third(i, j);
              const bool     is_window = is_in_first(i, j) || is_in_second(i, j);
              if (is_in_first(i, j) && !is_third && i >= 6 && i <= 11 && j >= 19 &&
                  j <= 23)
                continue; // partly covered by the third window
              const CellMoments moments_of_own = levels.moments_on(coefficient, {cell});
              const auto        expected = is_third ? sum_up(finest, 9, coefficient, cell)
                                           : is_window ? sum_up(fine, 3, coefficient, cell)
                                                       : sum_up(coarse, 1, coefficient, cell);
              ++n_compared[is_third ? 2 : is_window ? 1 : 0];
              for (std::size_t m = 0; m < expected.size(); ++m)
                EXPECT_NEAR(moments_of_own[0][m], expected[m], 1e-11 * (1. + expected[0]))
                  << i << ' ' << j << ' ' << m;
            }
      EXPECT_EQ(n_compared[2], 2 * 4 * 3);
      EXPECT_GT(n_compared[1], 50);
      EXPECT_GT(n_compared[0], 800);
    }

    // Cells of several spacings are summed up from those of the grid, so that they are
    // the sums of their children to rounding. Smaller cells are integrated one by one,
    // and differ from the sums by the error of quadrature.
    TEST_P(GapFieldLevels, CellsAreTheSumsOfTheirChildren)
    {
      const GapField   levels = field_of(on_grid_with(windows, .7));
      const MomentSet &set    = levels.moment_set();
      for (const Coefficient coefficient :
           {Coefficient::conductivity, Coefficient::resistivity})
        for (int exponent = 3; exponent > -4; --exponent)
          {
            // 200 cells from all over the box.
            const int n_cells = exponent > 0 ? n >> exponent : n << -exponent;
            for (int k = 0; k < 200; ++k)
              {
                const GridCell cell{exponent, (7 * k) % n_cells, (k * k + k) % n_cells};
                std::vector<GridCell> asked = {cell};
                for (int child = 0; child < 4; ++child)
                  asked.push_back(cell.child(child));
                const CellMoments   answers = levels.moments_on(coefficient, asked);
                std::vector<double> sums(set.size());
                for (int child = 0; child < 4; ++child)
                  set.add_child(sums.data(), &answers(child + 1, 0), child);
                const double tolerance = exponent > 0 ? 1e-12 : 1e-2;
                for (int m = 0; m < set.size(); ++m)
                  EXPECT_NEAR(answers[0][m], sums[m], tolerance * answers[0][0])
                    << exponent << ' ' << cell.i << ' ' << cell.j << ' ' << m;
              }
          }
    }

    // Cells that a window does not cover have the moments that they have without it.
    TEST(GapFieldLevels, WindowsChangeNothingElsewhere)
    {
      FluidParameters fluid;
      const SlabField with = on_grid_with({{-1, 1, 5, 5, 6, 6}}), without = on_grid(1);
      GapField        a(with.layout_pointer(), fluid), b(without.layout_pointer(), fluid);
      a.update(with);
      b.update(without);
      std::vector<GridCell> cells;
      for (int k = 0; k < n; ++k)
        cells.insert(cells.end(),
                     {{0, k, 4}, {0, k, 10}, {-1, 2 * k, 3}, {-2, 17, 4 * k}});
      cells.push_back({1, 8, 8});
      const auto x = a.moments_on(Coefficient::conductivity, cells);
      const auto y = b.moments_on(Coefficient::conductivity, cells);
      for (std::size_t c = 0; c < cells.size(); ++c)
        for (int m = 0; m < a.moment_set().size(); ++m)
          EXPECT_EQ(x[c][m], y[c][m]);
      // A window that is gone leaves no trace.
      a.update(without);
      EXPECT_EQ(a.moments_on(Coefficient::conductivity, {{0, 7, 7}})[0][0],
                b.moments_on(Coefficient::conductivity, {{0, 7, 7}})[0][0]);
    }

    FluidParameters
    fluid_with(const GapInterpolation interpolation,
               const unsigned int     degree,
               const FlowDirection    direction)
    {
      FluidParameters fluid;
      fluid.viscosity      = 1. / 12;
      fluid.interpolation  = interpolation;
      fluid.element_degree = degree;
      fluid.direction      = direction;
      return fluid;
    }

    INSTANTIATE_TEST_SUITE_P(
      Fluids,
      GapFieldLevels,
      testing::Values(fluid_with(GapInterpolation::monotone_cubic, 1, FlowDirection::x),
                      fluid_with(GapInterpolation::bilinear, 1, FlowDirection::y),
                      fluid_with(GapInterpolation::monotone_cubic, 2, FlowDirection::y)));
  } // namespace
} // namespace strait
