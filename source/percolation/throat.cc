// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/rounding.h>
#include <strait/percolation/channel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace strait
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    /** The open gap at any position, on all levels. Collective. */
    struct GapAround
    {
      const SlabField                   &gap; // of the contact
      const SlabLayout                  &layout;
      double                             slip_length;
      std::map<int, std::vector<double>> rows = {}; // of the grid, fetched so far

      double
      at(const int window, const int ix, const int iy)
      {
        if (window >= 0)
          return open_gap(gap[layout.index_of({ix, iy, window})], slip_length);
        const int            nx  = layout.grid().nx;
        std::vector<double> &row = rows[iy];
        if (row.empty())
          row = fetch_rows(gap, {iy});
        return open_gap(row[((ix % nx) + nx) % nx], slip_length);
      }

      /** The finest window around a position; −1 if there is none. */
      int
      window_at(const double x, const double y) const
      {
        int result = -1;
        for (int w = 0; w < static_cast<int>(layout.windows().size()); ++w)
          {
            const ZoomWindow &window = layout.windows()[w];
            const auto [a, b]        = indices(w, x, y);
            if ((result < 0 || window.level > layout.windows()[result].level) && a >= 1 &&
                a <= window.n_columns() - 2 && b >= 1 && b <= window.n_rows() - 2)
              result = w;
          }
        return result;
      }

      /**
       * g^(2/3) at a position, which falls to zero linearly at the contact line. It is
       * interpolated between points of the finest level there: by cubic polynomials where
       * they are all open, bilinearly beside closed ones.
       */
      double
      root_at(const double x, const double y)
      {
        const int window  = window_at(x, y);
        const auto [a, b] = indices(window, x, y);
        const int    ix   = static_cast<int>(std::floor(a));
        const int    iy   = static_cast<int>(std::floor(b));
        const double s = a - ix, t = b - iy;
        if (const auto cubic =
              interpolate(window, ix, iy, cubic_weights(s), cubic_weights(t)))
          return *cubic;
        return *interpolate(
          window, ix, iy, {{0., 1 - s, s, 0.}}, {{0., 1 - t, t, 0.}}, true);
      }

    private:
      /** Weights of the points −1, 0, 1 and 2; the position lies between 0 and 1. */
      using Weights = std::array<double, 4>;

      static Weights
      cubic_weights(const double s)
      {
        return {{-s * (s - 1) * (s - 2) / 6,
                 (s + 1) * (s - 1) * (s - 2) / 2,
                 -(s + 1) * s * (s - 2) / 2,
                 (s + 1) * s * (s - 1) / 6}};
      }

      /** Interpolate; nothing if a point that counts is closed, unless @p with_closed. */
      std::optional<double>
      interpolate(const int      window,
                  const int      ix,
                  const int      iy,
                  const Weights &along_x,
                  const Weights &along_y,
                  const bool     with_closed = false)
      {
        double value = 0.;
        for (int j = 0; j < 4; ++j)
          for (int i = 0; i < 4; ++i)
            if (const double weight = along_x[i] * along_y[j]; weight != 0.)
              {
                const double g = at(window, ix + i - 1, iy + j - 1);
                if (g <= 0 && !with_closed)
                  return {};
                value += weight * std::pow(std::max(g, 0.), 2. / 3.);
              }
        return value;
      }

      /** Column and row of a position in a window or the grid, integers at points. */
      std::array<double, 2>
      indices(const int window, const double x, const double y) const
      {
        const auto [x0, y0]          = layout.position(window, 0, 0);
        const auto [dx, dy]          = layout.spacing(window);
        const PeriodicGrid   &grid   = layout.grid();
        std::array<double, 2> result = {{(x - x0) / dx, (y - y0) / dy}};
        if (window >= 0)
          {
            result[0] -= std::floor((x - x0) / grid.lx) * grid.lx / dx;
            result[1] -= std::floor((y - y0) / grid.ly) * grid.ly / dy;
          }
        for (double &index : result)
          if (std::abs(index - std::round(index)) < rounding)
            index = std::round(index);
        return result;
      }
    };

    /** The distance along the unit vector @p u at which the gap at @p point has doubled;
     *  not a number if it closes first, or only beyond half the box's shorter side. */
    double
    doubling_length(GapAround                   &gap,
                    const GridPoint             &point,
                    const std::array<double, 2> &u)
    {
      const SlabLayout &layout  = gap.layout;
      const auto        origin  = layout.position(point.window, point.ix, point.iy);
      const double      longest = .5 * std::min(layout.grid().lx, layout.grid().ly);
      const auto        gap_at  = [&](const double t) {
        return std::pow(gap.root_at(origin[0] + t * u[0], origin[1] + t * u[1]), 1.5);
      };
      const double g0 = gap_at(0.);
      double       t0 = 0., g = g0;
      while (g > 0 && t0 < longest)
        {
          // One step: to the next point, if the line runs along the grid.
          const auto [dx, dy] =
            layout.spacing(gap.window_at(origin[0] + t0 * u[0], origin[1] + t0 * u[1]));
          const double t1 = t0 + 1. / std::max(std::abs(u[0]) / dx, std::abs(u[1]) / dy);
          const double next = gap_at(t1);
          if (next >= 2 * g0)
            return std::sqrt(t0 * t0 + (2 * g0 - g) / (next - g) * (t1 * t1 - t0 * t0));
          t0 = t1;
          g  = next;
        }
      return unknown;
    }
  } // namespace

  Throat
  measure_throat(const SlabField &gap, const double slip_length, const GridPoint &point)
  {
    GapAround  around{gap, gap.layout(), slip_length};
    bool       all_open = true;
    const auto g        = [&](const int i, const int j) {
      const double value = around.at(point.window, point.ix + i, point.iy + j);
      all_open           = all_open && value > 0;
      return value;
    };
    const auto [dx, dy] = around.layout.spacing(point.window);
    const double g0     = g(0, 0);
    const double xx     = (g(1, 0) - 2 * g0 + g(-1, 0)) / (dx * dx);
    const double yy     = (g(0, 1) - 2 * g0 + g(0, -1)) / (dy * dy);
    const double xy     = (g(1, 1) - g(1, -1) - g(-1, 1) + g(-1, -1)) / (4 * dx * dy);
    const double middle = .5 * (xx + yy);
    const double radius = std::hypot(.5 * (xx - yy), xy);
    const double along = middle + radius, across = middle - radius;

    Throat throat;
    throat.gap         = g0;
    throat.length      = along > 0 ? std::sqrt(2 * g0 / along) : unknown;
    throat.width       = across < 0 ? std::sqrt(-2 * g0 / across) : unknown;
    const double angle = .5 * std::atan2(2 * xy, xx - yy);
    const double c = std::cos(angle), s = std::sin(angle);
    throat.spacing       = std::max(dx, dy);
    throat.points_across = 2. * throat.width / throat.spacing;
    if (g0 > 0)
      throat.doubling_length = .5 * (doubling_length(around, point, {{c, s}}) +
                                     doubling_length(around, point, {{-c, -s}}));
    const double length =
      std::isnan(throat.doubling_length) ? throat.length : throat.doubling_length;
    if (std::isnan(length))
      throat.points = all_open ? std::numeric_limits<double>::infinity() : 0.;
    else
      throat.points = length / throat.spacing;
    return throat;
  }
} // namespace strait
