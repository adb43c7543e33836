// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_interpolant.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace strait
{
  namespace
  {
    double
    limited_slope(const double left, const double right)
    {
      const double product = left * right;
      return product > 0 ? 2. * product / (left + right) : 0.;
    }

    /** Bounds of a quantity along a stretch of the grid lines. */
    struct Interval
    {
      double low, high;
    };

    Interval
    difference(const Interval &a, const Interval &b)
    {
      return {a.low - b.high, a.high - b.low};
    }

    Interval
    limited_slope(const Interval &left, const Interval &right)
    {
      return {limited_slope(left.low, right.low), limited_slope(left.high, right.high)};
    }

    /** The cubic with these values and slopes at its ends. */
    GapInterpolant::Cubic
    hermite(const double start,
            const double slope_at_start,
            const double end,
            const double slope_at_end)
    {
      const double rise = end - start;
      return {start,
              slope_at_start,
              3. * rise - 2. * slope_at_start - slope_at_end,
              slope_at_start + slope_at_end - 2. * rise};
    }

    /** The Bézier control polygon of a cubic on t0 <= t <= t1. */
    std::array<double, 4>
    control_polygon(const GapInterpolant::Cubic &cubic, const double t0, const double t1)
    {
      const double start = cubic(t0), end = cubic(t1), third = (t1 - t0) / 3.;
      return {{start,
               start + third * cubic.derivative(t0),
               end - third * cubic.derivative(t1),
               end}};
    }
  } // namespace

  bool
  GapInterpolant::may_be_open(const GapStencil &gap)
  {
    const bool lower_left = gap[1][1] > 0, lower_right = gap[1][2] > 0;
    const bool upper_left = gap[2][1] > 0, upper_right = gap[2][2] > 0;
    const int  n_open = lower_left + lower_right + upper_left + upper_right;
    if (n_open == 2)
      return lower_left != upper_right;
    return n_open > 0;
  }

  GapInterpolant::Cubic
  GapInterpolant::between(const double v0,
                          const double v1,
                          const double v2,
                          const double v3) const
  {
    const double rise = v2 - v1;
    if (kind == GapInterpolation::bilinear)
      return {v1, rise, 0., 0.};
    const double left  = limited_slope(v1 - v0, rise),
                 right = limited_slope(rise, v3 - v2);
    return hermite(v1, left, v2, right);
  }

  CellGap::CellGap(const GapInterpolant &interpolant_, const GapStencil &gap)
    : interpolant(interpolant_)
    , along_x(interpolant.direction == FlowDirection::x)
  {
    for (int k = 0; k < 4; ++k)
      lines[k] = along_x
                   ? interpolant.between(gap[k][0], gap[k][1], gap[k][2], gap[k][3])
                   : interpolant.between(gap[0][k], gap[1][k], gap[2][k], gap[3][k]);
  }

  void
  CellGap::evaluate(const int n, const double *x, const double *y, double *result) const
  {
    const double *first = along_x ? x : y, *second = along_x ? y : x;
    const int     first_stride = along_x ? 1 : n, second_stride = along_x ? n : 1;
    for (int i = 0; i < n; ++i)
      {
        const double                t = first[i];
        const GapInterpolant::Cubic cubic =
          interpolant.between(lines[0](t), lines[1](t), lines[2](t), lines[3](t));
        for (int j = 0; j < n; ++j)
          result[i * first_stride + j * second_stride] = std::max(cubic(second[j]), 0.);
      }
  }

  CellGap::Range
  CellGap::range(const double x0,
                 const double y0,
                 const double width,
                 const double height) const
  {
    const double x[2] = {x0, x0 + width}, y[2] = {y0, y0 + height};
    if (interpolant.kind == GapInterpolation::bilinear)
      {
        double values[4];
        evaluate(2, x, y, values);
        const auto [lowest, highest] = std::minmax_element(values, values + 4);
        return {*lowest, *highest};
      }
    const double *first = along_x ? x : y, *second = along_x ? y : x;
    const bool    is_whole = width == 1. && height == 1.;
    double        ends[4][2];
    for (int k = 0; k < 4; ++k)
      for (int end = 0; end < 2; ++end)
        ends[k][end] = lines[k](first[end]);
    Interval line[4];
    for (int k = 0; k < 4; ++k)
      line[k] = {std::min(ends[k][0], ends[k][1]), std::max(ends[k][0], ends[k][1])};
    // Between two grid lines the gap lies between its values on them.
    Range range{std::max(std::min(line[1].low, line[2].low), 0.),
                std::max({line[1].high, line[2].high, 0.})};
    // Where the gaps on two lines are equal at an end, as in contact, they differ by
    // rounding, which must not decide. Bends that are overlooked change the gap by a
    // relative 1e-5.
    double least = -1e-10 * range.highest * range.highest;
    for (int k = 0; k < 3; ++k)
      if (const double product =
            (ends[k + 1][0] - ends[k][0]) * (ends[k + 1][1] - ends[k][1]);
          product < least)
        {
          range.crossing = k;
          least          = product;
        }
    if (is_whole)
      return range;
    const Interval rise  = difference(line[2], line[1]),
                   left  = limited_slope(difference(line[1], line[0]), rise),
                   right = limited_slope(rise, difference(line[3], line[2]));
    const double t0 = second[0], t1 = second[1];
    const auto   lower =
      control_polygon(hermite(line[1].low, left.low, line[2].low, right.high), t0, t1);
    const auto upper =
      control_polygon(hermite(line[1].high, left.high, line[2].high, right.low), t0, t1);
    range.lowest = std::max(range.lowest, *std::min_element(lower.begin(), lower.end()));
    range.highest =
      std::min(range.highest, *std::max_element(upper.begin(), upper.end()));
    return range;
  }

  double
  CellGap::bend(const int crossing, const double from, const double to) const
  {
    const auto apart = [this, crossing](const double t) {
      return lines[crossing + 1](t) - lines[crossing](t);
    };
    std::uintmax_t most_steps  = std::numeric_limits<double>::digits;
    const auto [first, second] = boost::math::tools::toms748_solve(
      apart, from, to, boost::math::tools::eps_tolerance<double>(), most_steps);
    return .5 * (first + second);
  }

  GapStencil
  GapRows::stencil(const int ix, const int iy) const
  {
    GapStencil gap;
    for (int b = 0; b < 4; ++b)
      {
        const double *line =
          rows.data() + static_cast<std::size_t>(iy - first_row - 1 + b) * grid.nx;
        // Remainders (%) would take longer than all else that is done with the values.
        for (int a = 0; a < 4; ++a)
          {
            const int i = ix + a - 1;
            gap[b][a]   = line[i < 0 ? i + grid.nx : i < grid.nx ? i : i - grid.nx];
          }
      }
    return gap;
  }

  double
  GapRows::operator()(const double x, const double y) const
  {
    const double s = x / grid.dx(), t = y / grid.dy();
    const int    n_rows = static_cast<int>(rows.size()) / grid.nx;
    const int    ix     = std::clamp(static_cast<int>(std::floor(s)), 0, grid.nx - 1);
    const int    iy =
      std::clamp(static_cast<int>(std::floor(t)), first_row + 1, first_row + n_rows - 3);
    const GapStencil gap = stencil(ix, iy);
    if (!GapInterpolant::may_be_open(gap))
      return 0.;
    const double in_x   = std::clamp(s - ix, 0., 1.);
    const double in_y   = std::clamp(t - iy, 0., 1.);
    double       result = 0.;
    CellGap(interpolant, gap).evaluate(1, &in_x, &in_y, &result);
    return result;
  }
} // namespace strait
