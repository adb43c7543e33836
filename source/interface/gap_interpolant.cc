// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_interpolant.h>

#include <algorithm>

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

    constexpr int max_points = 4;

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
      double on_line[4][max_points];
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
} // namespace strait
