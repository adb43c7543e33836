// SPDX-License-Identifier: GPL-2.0-or-later
// Leak rates of gaps that are known more finely in nested windows.
#include <strait/flow/constrictions.h>
#include <strait/reference/plate_flow.h>

#include <deal.II/base/timer.h>

#include <gtest/gtest.h>

#include <cstdio>

#include "flow_fixture.h"

namespace strait
{
  namespace
  {
    /** The straight way through the middle of the box, along x, by the points of the
     *  finest level: what percolation would find. */
    FlowPath
    straight_path(const SlabField &field, const GapFunction &gap)
    {
      const SlabLayout &layout = field.layout();
      FlowPath          path;
      // Steps of the finest spacing, of which those are kept that hit a point.
      std::function<void(int, int, int, int)> add =
        [&](const int window, const int first, const int end, const int row) {
          for (int ix = first; ix < end; ++ix)
            if (const int w = layout.covered_by(window, ix, row); w >= 0)
              {
                const ZoomWindow &of = layout.windows()[w];
                if (ix == of.x)
                  add(w, 1, of.n_columns() - 1, 3 * (row - of.y) + 1);
              }
            else
              {
                const auto [x, y] = layout.position(window, ix, row);
                path.points.push_back({ix, row, window});
                path.gaps.push_back(gap(x, y));
              }
        };
      const int n = field.grid().nx;
      add(-1, 0, n, field.grid().ny / 2);
      path.points.push_back({n, field.grid().ny / 2, -1});
      path.gaps.push_back(gap(0., .5));
      std::size_t narrowest = 0;
      path.resistances      = {0.};
      for (std::size_t k = 1; k < path.points.size(); ++k)
        {
          const auto at = [&](const std::size_t i) {
            const GridPoint &p = path.points[i];
            return layout.position(p.window, p.ix, p.iy)[0];
          };
          path.resistances.push_back(
            path.resistances.back() +
            .5 * (at(k) - at(k - 1)) *
              (std::pow(path.gaps[k], -3) + std::pow(path.gaps[k - 1], -3)));
          if (path.gaps[k] < path.gaps[narrowest])
            narrowest = k;
        }
      path.bottleneck     = path.points[narrowest];
      path.bottleneck_gap = path.gaps[narrowest];
      return path;
    }

    struct Solved
    {
      Solved(const GapFunction     &function,
             const SlabField       &gap,
             const FluidParameters &fluid)
        : field(gap.layout_pointer(), fluid)
      {
        const dealii::Timer timer;
        channel.gap   = gap;
        channel.paths = {straight_path(gap, function)};
        field.update(gap,
                     1e-8 * field.conductivity_of(channel.paths.front().bottleneck_gap));
        cells = find_critical_cells(channel);
        solver.emplace(fluid, field, cells);
        n_start = solver->mesh().triangulation().n_global_active_cells();
        flow    = solver->run([&](const Leakage &now) {
          std::printf("  %llu %g %g\n", now.unknowns, now.mesh_lower, now.mesh_upper);
        });
        seconds = timer.wall_time();
        std::printf(
          "%d windows: %g … %g, %u meshes from %llu cells, %llu unknowns, %.2f s\n",
          static_cast<int>(gap.layout().windows().size()),
          flow.lower,
          flow.upper,
          flow.refinements + 1,
          n_start,
          flow.unknowns,
          seconds);
      }

      Channel                       channel;
      std::vector<GridCell>         cells;
      GapField                      field;
      std::optional<ReynoldsSolver> solver;
      Leakage                       flow;
      unsigned long long            n_start = 0;
      double                        seconds = 0;
    };

    /** A saddle, as between the spots of a square pattern of contacts. */
    GapFunction
    saddle(const double gap)
    {
      return [gap](const double x, const double y) {
        return gap + .5 * (std::cos(2 * pi * (y - .5)) - std::cos(2 * pi * (x - .5)));
      };
    }

    /** @p n_levels windows around the middle of an n × n grid, each covering @p n_covered
     *  points of its parent each way. */
    SlabLayoutPtr
    nested(const int n, const int n_levels, const int n_covered)
    {
      std::vector<ZoomWindow> windows;
      int                     middle = n / 2;
      for (int l = 1; l <= n_levels; ++l)
        {
          const int first = middle - n_covered / 2;
          windows.push_back({l - 2, l, first, first, n_covered, n_covered});
          middle = 3 * (middle - first) + 1;
        }
      return with_windows(*make_layout({n, n, 1., 1.}, MPI_COMM_WORLD), windows);
    }

    TEST(FlowWindows, NarrowSaddleIsThatOfAFinerGridParallel)
    {
      const FluidParameters fluid = plain_fluid(1e-2);
      const GapFunction     gap   = saddle(1e-3);
      const Solved          fine(gap,
                        sample(make_layout({432, 432, 1., 1.}, MPI_COMM_WORLD), gap),
                        fluid);
      const Solved          windows(gap, sample(nested(48, 2, 18), gap), fluid);
      const Solved          larger(gap, sample(nested(48, 2, 26), gap), fluid);
    }

    TEST(FlowWindows, DeepSaddle)
    {
      const FluidParameters fluid = plain_fluid(1e-2);
      const GapFunction     gap   = saddle(1e-7);
      for (const int n : {60, 90})
        const Solved windows(gap, sample(nested(256, 6, n), gap), fluid);
    }
  } // namespace
} // namespace strait
