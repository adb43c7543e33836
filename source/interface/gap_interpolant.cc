// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_interpolant.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

    /** Cubic on the interval between the inner two of four values. */
    struct MonotoneCubic
    {
      MonotoneCubic(const double v0, const double v1, const double v2, const double v3)
        : value(v1)
        , rise(v2 - v1)
        , slope_left(limited_slope(v1 - v0, rise))
        , slope_right(limited_slope(rise, v3 - v2))
      {
      }

      double
      operator()(const double t) const
      {
        return value +
               t * (slope_left + t * (3. * rise - 2. * slope_left - slope_right +
                                      t * (slope_left + slope_right - 2. * rise)));
      }

      double value, rise, slope_left, slope_right;
    };

    /** What a number between grid lines can be. */
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

    /** The control polygon, on t0 <= t <= t1, of the cubic with control polygon @p b on
     *  0 <= t <= 1. */
    std::array<double, 4>
    control_polygon(const std::array<double, 4> &b, const double t0, const double t1)
    {
      const auto blossom = [&b](const double r, const double s, const double t) {
        std::array<double, 4> c = b;
        int                   n = 3;
        for (const double at : {r, s, t})
          {
            for (int i = 0; i < n; ++i)
              c[i] = (1. - at) * c[i] + at * c[i + 1];
            --n;
          }
        return c[0];
      };
      return {{blossom(t0, t0, t0),
               blossom(t0, t0, t1),
               blossom(t0, t1, t1),
               blossom(t1, t1, t1)}};
    }

    /** First along the second index of gap(line, ·), then across the lines. */
    template <class Gap>
    void
    interpolate_cubic(const Gap    &gap,
                      const int     n,
                      const double *first,
                      const double *second,
                      double       *result,
                      const int     first_stride,
                      const int     second_stride)
    {
      double on_line[4][GapInterpolant::max_points];
      for (int line = 0; line < 4; ++line)
        {
          const MonotoneCubic cubic(gap(line, 0),
                                    gap(line, 1),
                                    gap(line, 2),
                                    gap(line, 3));
          for (int i = 0; i < n; ++i)
            on_line[line][i] = cubic(first[i]);
        }
      for (int i = 0; i < n; ++i)
        {
          const MonotoneCubic cubic(on_line[0][i],
                                    on_line[1][i],
                                    on_line[2][i],
                                    on_line[3][i]);
          for (int j = 0; j < n; ++j)
            result[i * first_stride + j * second_stride] = std::max(cubic(second[j]), 0.);
        }
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

  void
  GapInterpolant::evaluate(const GapStencil &gap,
                           const int         n,
                           const double     *x,
                           const double     *y,
                           double           *result) const
  {
    if (kind == GapInterpolation::bilinear)
      {
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            {
              const double lower = (1 - x[i]) * gap[1][1] + x[i] * gap[1][2];
              const double upper = (1 - x[i]) * gap[2][1] + x[i] * gap[2][2];
              result[j * n + i]  = std::max((1 - y[j]) * lower + y[j] * upper, 0.);
            }
        return;
      }
    if (direction == FlowDirection::x)
      interpolate_cubic([&gap](const int line, const int i) { return gap[line][i]; },
                        n,
                        x,
                        y,
                        result,
                        1,
                        n);
    else
      interpolate_cubic([&gap](const int line, const int i) { return gap[i][line]; },
                        n,
                        y,
                        x,
                        result,
                        n,
                        1);
  }

  GapInterpolant::Range
  GapInterpolant::range(const GapStencil &gap,
                        const double      x0,
                        const double      y0,
                        const double      width,
                        const double      height) const
  {
    const double x[2] = {x0, x0 + width}, y[2] = {y0, y0 + height};
    if (kind == GapInterpolation::bilinear)
      {
        double values[4];
        evaluate(gap, 2, x, y, values);
        const auto [lowest, highest] = std::minmax_element(values, values + 4);
        return {*lowest, *highest, false};
      }
    const bool    along_x = direction == FlowDirection::x;
    const double *first = along_x ? x : y, *second = along_x ? y : x;
    const bool    is_whole = width == 1. && height == 1.;
    double        ends[4][2];
    for (int k = 0; k < 4; ++k)
      {
        const auto at = [&gap, along_x, k](const int i) {
          return along_x ? gap[k][i] : gap[i][k];
        };
        if (is_whole)
          {
            ends[k][0] = at(1);
            ends[k][1] = at(2);
            continue;
          }
        const MonotoneCubic cubic(at(0), at(1), at(2), at(3));
        ends[k][0] = cubic(first[0]);
        ends[k][1] = cubic(first[1]);
      }
    Interval line[4];
    for (int k = 0; k < 4; ++k)
      line[k] = {std::min(ends[k][0], ends[k][1]), std::max(ends[k][0], ends[k][1])};
    // Between the lines the gap is between those on the lines.
    Range range{std::max(std::min(line[1].low, line[2].low), 0.),
                std::max({line[1].high, line[2].high, 0.})};
    // Lines that are equal at an end, as in contact, differ there by rounding, which is
    // not to decide. Bends that are overlooked change the gap by a part of 1e-5.
    const double rounding = 1e-10 * range.highest * range.highest;
    for (int k = 0; k < 3; ++k)
      range.bends |=
        (ends[k + 1][0] - ends[k][0]) * (ends[k + 1][1] - ends[k][1]) < -rounding;
    if (is_whole)
      return range;
    const Interval rise  = difference(line[2], line[1]),
                   left  = limited_slope(difference(line[1], line[0]), rise),
                   right = limited_slope(rise, difference(line[3], line[2]));
    const auto lower     = control_polygon({{line[1].low,
                                             line[1].low + left.low / 3.,
                                             line[2].low - right.high / 3.,
                                             line[2].low}},
                                       second[0],
                                       second[1]);
    const auto upper     = control_polygon({{line[1].high,
                                             line[1].high + left.high / 3.,
                                             line[2].high - right.low / 3.,
                                             line[2].high}},
                                       second[0],
                                       second[1]);
    range.lowest = std::max(range.lowest, *std::min_element(lower.begin(), lower.end()));
    range.highest =
      std::min(range.highest, *std::max_element(upper.begin(), upper.end()));
    return range;
  }

  GapRows::GapRows(const PeriodicGrid   &grid_,
                   const GapInterpolant &interpolant_,
                   const int             first_row_,
                   std::vector<double>   rows_)
    : grid(grid_)
    , interpolant(interpolant_)
    , first_row(first_row_)
    , rows(std::move(rows_))
  {
  }

  double
  GapRows::operator()(const double x, const double y) const
  {
    const double s = x / grid.dx(), t = y / grid.dy();
    const int    n_rows = static_cast<int>(rows.size()) / grid.nx;
    const int    ix     = std::clamp(static_cast<int>(std::floor(s)), 0, grid.nx - 1);
    const int    row =
      std::clamp(static_cast<int>(std::floor(t)) - first_row, 1, n_rows - 3);
    GapStencil gap;
    for (int b = 0; b < 4; ++b)
      {
        const double *line =
          rows.data() + static_cast<std::size_t>(row - 1 + b) * grid.nx;
        for (int a = 0; a < 4; ++a)
          gap[b][a] = line[(ix + a - 1 + grid.nx) % grid.nx];
      }
    if (!GapInterpolant::may_be_open(gap))
      return 0.;
    const double in_x   = std::clamp(s - ix, 0., 1.);
    const double in_y   = std::clamp(t - (first_row + row), 0., 1.);
    double       result = 0.;
    interpolant.evaluate(gap, 1, &in_x, &in_y, &result);
    return result;
  }
} // namespace strait
