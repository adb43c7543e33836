// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/gap_around.h>
#include <strait/percolation/throat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    constexpr double unknown  = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Measures of a throat along straight lines through its narrowest point. */
    class ThroatWalk
    {
    public:
      ThroatWalk(GapAround &gap_, const SlabLayout &layout_, const GridPoint &point_)
        : gap(gap_)
        , layout(layout_)
        , origin(layout_.position(point_.window, point_.ix, point_.iy))
        , start(root(0., {{1., 0.}}, false))
      {
      }

      using Direction = std::array<double, 2>;

      /** How far from the point the gap has doubled, in direction @p u. */
      double
      doubling_length(const Direction &u) const
      {
        const double g0 = std::pow(start, 1.5);
        double       t0 = 0., g = g0;
        while (g > 0 && t0 < longest())
          {
            const double t1   = t0 + step(t0, u);
            const double next = std::pow(root(t1, u, false), 1.5);
            if (next >= 2 * g0)
              return std::sqrt(t0 * t0 + (2 * g0 - g) / (next - g) * (t1 * t1 - t0 * t0));
            t0 = t1;
            g  = next;
          }
        return unknown;
      }

      /**
       * How far from the point the gap vanishes, in direction @p u: g^(2/3), which is
       * linear in t² in the gap (w² − t²)^(3/2) between two lines of contact,
       * extrapolated from the last two positions between open points.
       */
      double
      half_width(const Direction &u) const
      {
        double t0 = 0., t1 = 0., q0 = 0., q1 = start;
        while (t1 < longest())
          {
            const double t2 = t1 + step(t1, u), q2 = root(t2, u, true);
            if (!(q2 > 0)) // closed, or unknown
              break;
            t0 = std::exchange(t1, t2);
            q0 = std::exchange(q1, q2);
          }
        if (!(t0 > 0) || !(q0 > q1) || t1 >= longest())
          return unknown;
        const double t = std::sqrt(t1 * t1 + q1 / (q0 - q1) * (t1 * t1 - t0 * t0));
        return t >= 3 * step(0., u) ? t : unknown;
      }

    private:
      /** Lines end half-way round the box. */
      double
      longest() const
      {
        return .5 * std::min(layout.grid().lx, layout.grid().ly);
      }

      double
      root(const double t, const Direction &u, const bool open_only) const
      {
        return gap.root_at(origin[0] + t * u[0], origin[1] + t * u[1], open_only);
      }

      /** To the next position, which is the next point on lines along the grid. */
      double
      step(const double t, const Direction &u) const
      {
        const auto [dx, dy] =
          layout.spacing(gap.window_at(origin[0] + t * u[0], origin[1] + t * u[1]));
        return 1. / std::max(std::abs(u[0]) / dx, std::abs(u[1]) / dy);
      }

      GapAround            &gap;
      const SlabLayout     &layout;
      std::array<double, 2> origin;
      double                start;
    };

    /** All of a throat that @p gap tells. */
    Throat
    measure(GapAround &gap, const SlabLayout &layout, const GridPoint &point)
    {
      bool       all_open = true;
      const auto g        = [&](const int i, const int j) {
        const double value = gap.at(point.window, point.ix + i, point.iy + j);
        all_open           = all_open && value > 0;
        return value;
      };
      const auto [dx, dy] = layout.spacing(point.window);
      const double g0     = g(0, 0);
      const double xx     = (g(1, 0) - 2 * g0 + g(-1, 0)) / (dx * dx);
      const double yy     = (g(0, 1) - 2 * g0 + g(0, -1)) / (dy * dy);
      const double xy     = (g(1, 1) - g(1, -1) - g(-1, 1) + g(-1, -1)) / (4 * dx * dy);
      const double middle = .5 * (xx + yy);
      const double radius = std::hypot(.5 * (xx - yy), xy);
      const double along = middle + radius, across = middle - radius;

      Throat throat;
      throat.gap    = g0;
      throat.length = along > 0 ? std::sqrt(2 * g0 / along) : unknown;
      throat.width  = across < 0 ? std::sqrt(-2 * g0 / across) : unknown;
      if (g0 > 0)
        {
          const ThroatWalk walk(gap, layout, point);
          const double     angle = .5 * std::atan2(2 * xy, xx - yy);
          const double     c = std::cos(angle), s = std::sin(angle);
          throat.doubling_length =
            .5 * (walk.doubling_length({{c, s}}) + walk.doubling_length({{-c, -s}}));
          throat.half_width =
            .5 * (walk.half_width({{-s, c}}) + walk.half_width({{s, -c}}));
        }
      const double length =
        std::isnan(throat.doubling_length) ? throat.length : throat.doubling_length;
      if (std::isnan(length))
        throat.points = all_open ? infinity : 0.;
      else
        throat.points = length / std::max(dx, dy);
      return throat;
    }
  } // namespace

  Throat
  measure_throat(const SlabField &gap, const double slip_length, const GridPoint &point)
  {
    const SlabLayout &layout = gap.layout();
    const int         ny     = gap.grid().ny;
    const auto [dx, dy]      = layout.spacing(-1);
    const int row =
      static_cast<int>(std::floor(layout.position(point.window, 0, point.iy)[1] / dy));
    Throat throat;
    // Rank 0 asks for more rows until those suffice.
    int is_complete = 0;
    for (int reach = 16; is_complete == 0; reach *= 2)
      {
        std::vector<int> rows;
        for (int k = row - reach; layout.rank() == 0 && k <= row + reach; ++k)
          rows.push_back(k);
        GapAround around(gap, slip_length, row - reach, fetch_rows(gap, rows));
        if (layout.rank() == 0)
          {
            throat      = measure(around, layout, point);
            is_complete = around.is_complete() || reach > ny ? 1 : 0;
          }
        MPI_Bcast(&is_complete, 1, MPI_INT, 0, layout.communicator());
      }
    static_assert(sizeof(Throat) == 6 * sizeof(double));
    MPI_Bcast(&throat, 6, MPI_DOUBLE, 0, layout.communicator());
    return throat;
  }
} // namespace strait
