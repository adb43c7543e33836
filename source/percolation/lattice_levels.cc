// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/lattice_levels.h>

#include <cmath>

namespace strait
{
  LatticeLevels::LatticeLevels(const SlabLayout &layout, const FlowDomain &domain)
    : along_x(domain.region != nullptr || domain.direction == FlowDirection::x)
    , is_periodic(domain.region == nullptr)
    , length(layout.grid().nx + (along_x ? 1 : 0))
    , lines_per_point(1. / length)
  {
    find_lines(layout);
    const PeriodicGrid  &grid = layout.grid();
    const double         dx = grid.dx(), dy = grid.dy();
    const std::ptrdiff_t line = length;
    levels.push_back({(along_x ? grid.nx : grid.ny) + 1,
                      (along_x ? grid.ny : grid.nx) + (is_periodic ? 0 : 1),
                      {{along_x ? dx : dy, along_x ? dy : dx, std::hypot(dx, dy)}},
                      along_x ? 1 : line,
                      along_x ? line : 1});
    const int n_windows = static_cast<int>(layout.windows().size());
    for (int w = 0; w < n_windows; ++w)
      add_window(layout, w);
  }

  void
  LatticeLevels::find_lines(const SlabLayout &layout)
  {
    const int ny = layout.grid().ny;
    if (!is_periodic)
      {
        end       = layout.rank() == 0 ? ny + 1 : 0;
        n_on_grid = end_own = static_cast<std::size_t>(end) * length;
        return;
      }
    const int first_row = layout.first_row(), n_rows = layout.n_rows();
    if (n_rows == 0)
      return;
    // If the flow is along y, the outlet's copy of the first line follows the last one.
    const bool has_copy   = !along_x && first_row + n_rows == ny;
    const bool has_before = along_x || first_row > 0;
    const bool has_after  = along_x || first_row + n_rows < ny;
    const int  n_own      = n_rows + (has_copy ? 1 : 0);
    first                 = first_row - (has_before ? 1 : 0);
    end                   = first_row + n_own + (has_after ? 1 : 0);
    n_on_grid             = static_cast<std::size_t>(end - first) * length;
    first_own             = has_before ? length : 0;
    end_own               = first_own + static_cast<std::size_t>(n_own) * length;
  }

  void
  LatticeLevels::add_window(const SlabLayout &layout, const int w)
  {
    const ZoomWindow &window    = layout.windows()[w];
    const int         n_columns = along_x ? window.n_columns() : window.n_rows();
    const int         seam      = layout.seam(w, along_x ? 0 : 1);
    for (const bool ends_at_outlet : {true, false})
      {
        if (ends_at_outlet && seam < 0)
          continue;
        const bool begins_at_inlet = seam >= 0 && !ends_at_outlet;
        const int  first           = begins_at_inlet ? seam - 1 : 0;
        const int  end_of_part     = ends_at_outlet ? seam + 2 : n_columns;
        // The first of the parent's columns that this part covers. Columns of the grid
        // run from 0, at the inlet, to the period, its copy at the outlet.
        int along = (along_x ? window.x : window.y) + first / 3;
        if (window.parent < 0)
          {
            const int period = levels.front().n_along - 1;
            along            = (along % period + period) % period;
            if (along == 0 && ends_at_outlet)
              along = period;
          }
        Level level           = levels.front();
        level.begin           = n_points();
        level.n_along         = end_of_part - first;
        level.n_across        = along_x ? window.n_rows() : window.n_columns();
        level.along_by        = 1;
        level.across_by       = level.n_along;
        level.parent          = level_with(window.parent, along, ends_at_outlet);
        level.along           = along - levels[level.parent].first;
        level.across          = along_x ? window.y : window.x;
        level.window          = w;
        level.first           = first;
        level.begins_at_inlet = begins_at_inlet;
        level.ends_at_outlet  = ends_at_outlet;
        for (double &length : level.lengths)
          length *= std::pow(3., -window.level);
        levels.push_back(level);
      }
  }

  int
  LatticeLevels::level_with(const int window, const int along, const bool of_outlet) const
  {
    if (window < 0)
      return 0;
    int l = 1;
    while (levels[l].window != window)
      ++l;
    // The first of two parts ends one column after that on the seam.
    if (!levels[l].ends_at_outlet)
      return l;
    const int seam = levels[l].n_along - 2;
    return along < seam || (along == seam && of_outlet) ? l : l + 1;
  }

  LatticeLevels::Place
  LatticeLevels::parent_of(const Place &p) const
  {
    const Level &level = levels[p.level];
    return {level.parent, level.along + p.along / 3, level.across + p.across / 3};
  }

  LatticeLevels::Place
  LatticeLevels::finest(const Place &p) const
  {
    for (std::size_t l = 1; l < levels.size(); ++l)
      {
        const Level &level = levels[l];
        if (level.parent != p.level)
          continue;
        const int a = p.along - level.along, from = p.across - level.across;
        const int b = p.level == 0 ? wrapped(from) : from;
        if (a >= 0 && 3 * a < level.n_along && b >= 0 && 3 * b < level.n_across)
          return finest({static_cast<int>(l), 3 * a + 1, 3 * b + 1});
      }
    return p;
  }

  bool
  LatticeLevels::is_on_rim(const Place &p) const
  {
    const Level &level  = levels[p.level];
    const bool   on_rim = p.along == 1 || p.along == level.n_along - 2 || p.across == 1 ||
                        p.across == level.n_across - 2;
    return on_rim && p.along % 3 == 1 && p.across % 3 == 1;
  }

  LatticeLevels::Place
  LatticeLevels::place(const GridPoint &p) const
  {
    const int along = along_x ? p.ix : p.iy, across = along_x ? p.iy : p.ix;
    const int level = level_with(p.window, along, false);
    return {level, along - levels[level].first, across};
  }

  GridPoint
  LatticeLevels::point(const Place &p) const
  {
    const Level &level  = levels[p.level];
    const int    along  = level.first + p.along;
    const int    across = p.level == 0 ? wrapped(p.across) : p.across;
    return along_x ? GridPoint{along, across, level.window}
                   : GridPoint{across, along, level.window};
  }
} // namespace strait
