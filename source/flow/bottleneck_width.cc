// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/bottleneck_width.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    /** The gap so many points beside the bottleneck, each way; zero where there are none.
     */
    using GapBeside = std::function<double(int, int)>;

    GapBeside
    on_grid(const FlowLattice &lattice, const std::size_t k)
    {
      return [&lattice, k](const int i, const int j) {
        const int a = lattice.along(k) + i;
        const int b = (lattice.across_of(k) + j) % lattice.n_across();
        return a < 0 || a >= lattice.width() ? 0. : lattice[lattice.index(a, b)];
      };
    }

    GapBeside
    in_window(const SlabField &gap, const GridPoint &point)
    {
      const ZoomWindow &window = gap.layout().windows()[point.window];
      const double     *values = gap.data() + gap.layout().start_of_window(point.window);
      return [&window, values, point](const int i, const int j) {
        const int  a = point.ix + i, b = point.iy + j;
        const bool inside =
          a >= 0 && a < window.n_columns() && b >= 0 && b < window.n_rows();
        return inside ? values[static_cast<std::size_t>(b) * window.n_columns() + a] : 0.;
      };
    }
  } // namespace

  double
  bottleneck_width(const SlabField   &gap,
                   const FlowLattice &lattice,
                   const FlowPath    &path,
                   const double       otherwise)
  {
    constexpr double infinity  = std::numeric_limits<double>::infinity();
    const GridPoint &point     = path.bottleneck;
    const bool       is_zoomed = point.window >= 0;
    const GapBeside  gap_at =
      is_zoomed ? in_window(gap, point) : on_grid(lattice, lattice.index_of(point));
    const int n_most = is_zoomed ? gap.layout().windows()[point.window].n_columns() +
                                     gap.layout().windows()[point.window].n_rows()
                                 : lattice.n_across() / 2;
    double    best   = infinity; // in spacings
    for (const auto &[da, db] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}})
      {
        double width = 1.;
        for (const int side : {-1, 1})
          for (int s = 1; s < n_most; ++s)
            {
              const double g = gap_at(side * s * da, side * s * db) / path.bottleneck_gap;
              if (!(g > 0))
                break;
              if (g > 1.001) // this is not the way across
                {
                  width = infinity;
                  break;
                }
              width += g * g * g;
            }
        best = std::min(best, width);
      }
    const auto [dx, dy] = gap.layout().spacing(point.window);
    return std::isfinite(best) ? std::min(dx, dy) * best : otherwise;
  }
} // namespace strait
