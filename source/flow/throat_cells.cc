// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/throat_cells.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // Edge of the cells around a narrowest point in a window, of their distance from it.
    // Half of it starts with three times as many cells to save one mesh; double of it
    // takes three or four meshes more to see the contact beside the throat.
    constexpr double fraction_of_distance = .5;

    /** Add the cells around @p throat, a point of a window, that are larger than the
     *  spacing there and than a fraction of their distance from it. */
    void
    add_around(const GridPoint    &throat,
               const SlabLayout   &layout,
               const FlowDirection direction,
               const int           largest_exponent,
               std::set<GridCell> &cells)
    {
      // In cells: what touches the circle only is not in it, wherever the box begins.
      // Half and double of it decide alike.
      constexpr double    rounding = 1e-6;
      const PeriodicGrid &grid     = layout.grid();
      const double        spacing  = std::pow(3., -layout.windows()[throat.window].level);
      const double        reach    = 1. / fraction_of_distance - rounding; // in cells
      auto [x, y]                  = layout.position(throat.window, throat.ix, throat.iy);
      x -= grid.lx * std::floor(x / grid.lx); // of a window across the seam
      y -= grid.ly * std::floor(y / grid.ly);
      for (int e = largest_exponent; std::ldexp(1., e) > spacing; --e)
        {
          const double s = std::ldexp(x / grid.dx(), -e),
                       t = std::ldexp(y / grid.dy(), -e);
          const int nx   = static_cast<int>(std::ldexp(grid.nx, -e));
          const int ny   = static_cast<int>(std::ldexp(grid.ny, -e));
          // The seam is a border along the flow alone.
          const auto add = [&](const int i, const int j) {
            const bool inside =
              direction == FlowDirection::x ? i >= 0 && i < nx : j >= 0 && j < ny;
            if (inside)
              cells.insert({e, (i + nx) % nx, (j + ny) % ny});
          };
          for (int j = static_cast<int>(std::floor(t - reach)); j <= t + reach; ++j)
            for (int i = static_cast<int>(std::floor(s - reach)); i <= s + reach; ++i)
              if (std::hypot(std::max({i - s, s - (i + 1), 0.}),
                             std::max({j - t, t - (j + 1), 0.})) < reach)
                add(i, j);
        }
    }
  } // namespace

  std::set<GridCell>
  cells_around_throats(const Channel &channel, const int largest_exponent)
  {
    std::set<GridCell> cells;
    for (const FlowPath &path : channel.paths)
      for (const Constriction &c : divide_into_constrictions(path.gaps))
        {
          const auto gaps      = path.gaps.begin();
          const auto first     = gaps + static_cast<std::ptrdiff_t>(c.first);
          const auto end       = gaps + static_cast<std::ptrdiff_t>(c.last) + 1;
          const auto narrowest = path.points[std::min_element(first, end) - gaps];
          if (narrowest.window >= 0)
            add_around(narrowest,
                       channel.gap.layout(),
                       channel.domain.direction,
                       largest_exponent,
                       cells);
        }
    return cells;
  }
} // namespace strait
