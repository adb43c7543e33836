// SPDX-License-Identifier: GPL-2.0-or-later
// For any gap at the grid points, its range on a cell and the moments of its coefficients
// are bounds, and close ones where the gap varies little.
#include <strait/interface/cell_quadrature.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strait
{
  namespace
  {
    class CellQuadratures : public testing::TestWithParam<FluidParameters>
    {
    protected:
      double
      number(const double low, const double high)
      {
        return std::uniform_real_distribution<double>(low, high)(random);
      }

      /** Return random gaps that differ by factors of up to exp(@p variation). */
      GapStencil
      stencil(const double variation)
      {
        GapStencil gap;
        for (auto &row : gap)
          for (double &value : row)
            value = std::exp(number(-.5, .5) * variation);
        return gap;
      }

      /** Return a random square with a quarter, a half or all of the cell's edge. */
      Square
      square()
      {
        const double edge =
          std::ldexp(1., -std::uniform_int_distribution<>(0, 2)(random));
        return {edge * std::floor(number(0., 1. / edge)),
                edge * std::floor(number(0., 1. / edge)),
                edge};
      }

      std::mt19937 random{5};
    };

    TEST_P(CellQuadratures, RangeHoldsTheGapAndNarrowsWithTheRectangle)
    {
      const GapInterpolant interpolant{GetParam().interpolation, GetParam().direction};
      for (int k = 0; k < 300; ++k)
        {
          const GapStencil gap  = stencil(number(.1, 8.));
          double           edge = 1., widest = 0.;
          for (int halving = 0; halving < 8; ++halving, edge *= .5)
            {
              const double  x0 = number(0., 1. - edge), y0 = number(0., 1. - edge);
              const CellGap cell(interpolant, gap);
              const auto    range = cell.range(x0, y0, edge, edge);
              double        x[3], y[3], values[9];
              for (int i = 0; i < 3; ++i)
                {
                  x[i] = x0 + edge * (i == 0 ? 0. : i == 1 ? number(0., 1.) : 1.);
                  y[i] = y0 + edge * (i == 0 ? 0. : i == 1 ? number(0., 1.) : 1.);
                }
              cell.evaluate(3, x, y, values);
              const auto [lowest, highest] = std::minmax_element(values, values + 9);
              EXPECT_LE(range.lowest, *lowest * (1 + 1e-12));
              EXPECT_GE(range.highest, *highest * (1 - 1e-12));
              if (halving == 0)
                widest = range.highest - range.lowest;
              // Along each axis the gap is at most twice as steep as on average over the
              // cell. As bounds on a part are not exact, twelve times are allowed.
              EXPECT_LE(range.highest - range.lowest, 12. * edge * widest);
            }
        }
    }

    TEST_P(CellQuadratures, MomentsAreBoundsFromAbove)
    {
      const CellQuadrature quadrature(GetParam());
      const GapInterpolant interpolant{GetParam().interpolation, GetParam().direction};
      constexpr int        n = 128; // midpoints along each axis for the expected integral
      for (int k = 0; k < 60; ++k)
        {
          const double         variation = number(.05, 4.);
          const GapStencil     gap       = stencil(variation);
          const Square         part      = square();
          const CoefficientLaw law{1., 1e-12, k % 2 == 0};
          std::vector<double>  moments(quadrature.moment_set().size());
          quadrature.integrate(gap, part, {{law, moments.data()}});
          const CellGap cell(interpolant, gap);
          double        expected = 0.;
          for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
              {
                const double x = part.x0 + part.edge * (i + .5) / n;
                const double y = part.y0 + part.edge * (j + .5) / n;
                double       value;
                cell.evaluate(1, &x, &y, &value);
                expected += law(value) / (n * n);
              }
          // Both quadrature rules may be wrong alike by chance, but by no more than this.
          EXPECT_GE(moments[0], expected * (1. - 5e-4)) << variation;
          if (!GetParam().rigorous_bounds && variation < 1.)
            {
              EXPECT_LE(moments[0], expected * (1. + 1e-2)) << variation;
            }
        }
    }

    TEST_P(CellQuadratures, RoundingDecidesNothing)
    {
      const CellQuadrature quadrature(GetParam());
      for (int k = 0; k < 400; ++k)
        {
          GapStencil gap = stencil(number(.1, 4.));
          for (auto &row : gap)
            for (double &value : row)
              if (k % 2 == 0 && number(0., 1.) < .4)
                value = 0.; // contact
          if (k % 4 == 1)   // two equal grid lines
            gap[2] = gap[1];
          if (k % 4 == 3) // symmetric about the diagonal
            for (int j = 0; j < 4; ++j)
              for (int i = 0; i < j; ++i)
                gap[j][i] = gap[i][j];
          GapStencil rounded = gap;
          for (auto &row : rounded)
            for (double &value : row)
              value *= 1. + number(-1e-13, 1e-13);
          Square part = square();
          part.edge *= k % 3 == 0 ? .125 : 1.;
          const CoefficientLaw law{1., 1e-12, (k / 4) % 2 == 0};
          std::vector<double>  moments(quadrature.moment_set().size()), others = moments;
          quadrature.integrate(gap, part, {{law, moments.data()}});
          quadrature.integrate(rounded, part, {{law, others.data()}});
          EXPECT_NEAR(moments[0], others[0], 1e-9 * moments[0]) << k;
        }
    }

    TEST_P(CellQuadratures, AConstantGapIsIntegratedExactly)
    {
      const CellQuadrature quadrature(GetParam());
      GapStencil           gap;
      for (auto &row : gap)
        row.fill(.5);
      for (const bool is_resistivity : {false, true})
        {
          std::vector<double> moments(quadrature.moment_set().size());
          quadrature.integrate(gap, {}, {{{1., 1e-9, is_resistivity}, moments.data()}});
          const double value = is_resistivity ? 8. : .125;
          EXPECT_NEAR(moments[0], value, 1e-14 * value);
          EXPECT_NEAR(moments[quadrature.moment_set().index(2, 0)],
                      value / 3.,
                      1e-14 * value);
        }
    }

    FluidParameters
    fluid_with(const GapInterpolation interpolation,
               const FlowDirection    direction,
               const unsigned int     degree          = 1,
               const bool             rigorous_bounds = false)
    {
      FluidParameters fluid;
      fluid.interpolation   = interpolation;
      fluid.direction       = direction;
      fluid.element_degree  = degree;
      fluid.rigorous_bounds = rigorous_bounds;
      return fluid;
    }

    INSTANTIATE_TEST_SUITE_P(
      Fluids,
      CellQuadratures,
      testing::Values(
        fluid_with(GapInterpolation::monotone_cubic, FlowDirection::x),
        fluid_with(GapInterpolation::monotone_cubic, FlowDirection::y, 2),
        fluid_with(GapInterpolation::bilinear, FlowDirection::x),
        fluid_with(GapInterpolation::monotone_cubic, FlowDirection::y, 1, true)));
  } // namespace
} // namespace strait
