// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  FlowLattice::FlowLattice(const std::vector<double> &whole,
                           const PeriodicGrid        &grid,
                           const FlowDomain          &domain)
    : region(domain.region)
    , along_x(region != nullptr || domain.direction == FlowDirection::x)
  {
    const double dx = grid.dx(), dy = grid.dy();
    const int    period = along_x ? grid.ny : grid.nx;
    levels.push_back({0,
                      (along_x ? grid.nx : grid.ny) + 1,
                      period + (region != nullptr ? 1 : 0),
                      {{along_x ? dx : dy,
                        along_x ? dy : dx,
                        std::hypot(along_x ? dx : dy, along_x ? dy : dx)}},
                      -1,
                      0,
                      0});
    n_on_grid = static_cast<std::size_t>(width()) * n_across();
    values.resize(n_on_grid);
    for (int b = 0; b < n_across(); ++b)
      for (int a = 0; a < width(); ++a)
        {
          const int         a0 = a % (width() - 1), b0 = b % period;
          const std::size_t k = index(a, b);
          if (is_point(k))
            values[k] = along_x ? whole[static_cast<std::size_t>(b0) * grid.nx + a0]
                                : whole[static_cast<std::size_t>(a0) * grid.nx + b0];
        }
  }

  FlowLattice::FlowLattice(const std::vector<double> &whole,
                           const SlabField           &field,
                           const FlowDomain          &domain)
    : FlowLattice(whole, field.grid(), domain)
  {
    const int n_windows = static_cast<int>(field.layout().windows().size());
    for (int w = 0; w < n_windows; ++w)
      add_window(field, w);
  }

  void
  FlowLattice::add_window(const SlabField &field, const int w)
  {
    const ZoomWindow &window = field.layout().windows()[w];
    const int         last   = (along_x ? window.n_columns() : window.n_rows()) - 1;
    const int         seam   = field.layout().seam(w, along_x ? 0 : 1);
    if (seam < 0)
      {
        add_part(field, w, {0, last, false, false});
        return;
      }
    add_part(field, w, {0, seam + 1, false, true});
    add_part(field, w, {seam - 1, last, true, false});
  }

  void
  FlowLattice::add_part(const SlabField &field, const int w, const Part &part)
  {
    const SlabLayout &layout   = field.layout();
    const ZoomWindow &window   = layout.windows()[w];
    const double      fraction = std::pow(3., -window.level);
    // The first of the parent's columns that this part covers; on the grid, of those that
    // begin at the inlet and end with its copy at the outlet.
    int along = (along_x ? window.x : window.y) + part.first / 3;
    if (window.parent < 0)
      {
        const int period = width() - 1;
        along            = (along % period + period) % period;
        if (along == 0 && part.ends_at_outlet)
          along = period;
      }
    Level level           = levels.front();
    level.begin           = values.size();
    level.n_along         = part.last - part.first + 1;
    level.n_across        = along_x ? window.n_rows() : window.n_columns();
    level.parent          = level_with(window.parent, along, part.ends_at_outlet);
    level.along           = along - levels[level.parent].first;
    level.across          = along_x ? window.y : window.x;
    level.window          = w;
    level.first           = part.first;
    level.begins_at_inlet = part.begins_at_inlet;
    level.ends_at_outlet  = part.ends_at_outlet;
    for (double &length : level.lengths)
      length *= fraction;
    levels.push_back(level);

    const std::size_t begin = layout.start_of_window(w);
    for (int b = 0; b < level.n_across; ++b)
      for (int a = part.first; a <= part.last; ++a)
        {
          const std::size_t ix = along_x ? a : b, iy = along_x ? b : a;
          values.push_back(field[begin + iy * window.n_columns() + ix]);
        }
    is_covered.resize(values.size(), false);
    for (int b = 1; b < level.n_across; b += 3)
      for (int a = 1; a < level.n_along; a += 3)
        {
          const Place place = {static_cast<int>(levels.size()) - 1, a, b};
          is_covered[number_of(on_parent(place))] = true;
        }
  }

  int
  FlowLattice::level_with(const int window, const int along, const bool of_outlet) const
  {
    if (window < 0)
      return 0;
    int l = 1;
    while (levels[l].window != window)
      ++l;
    // Of two parts the first ends with the column on the seam and one beyond.
    if (!levels[l].ends_at_outlet)
      return l;
    const int seam = levels[l].n_along - 2;
    return along < seam || (along == seam && of_outlet) ? l : l + 1;
  }

  FlowLattice::Place
  FlowLattice::on_parent(const Place &p) const
  {
    const Level &level = levels[p.level];
    return {level.parent, level.along + p.along / 3, level.across + p.across / 3};
  }

  std::size_t
  FlowLattice::finer(const std::size_t k) const
  {
    const Place p = place_of(k);
    for (std::size_t l = 1; l < levels.size(); ++l)
      {
        const Level &level = levels[l];
        if (level.parent != p.level)
          continue;
        const int a = p.along - level.along;
        int       b = p.across - level.across;
        if (p.level == 0)
          b = (b + n_across()) % n_across();
        if (a >= 0 && 3 * a < level.n_along && b >= 0 && 3 * b < level.n_across)
          return number_of({static_cast<int>(l), 3 * a + 1, 3 * b + 1});
      }
    return none;
  }

  std::size_t
  FlowLattice::on_parent_of_rim(const int l, const std::size_t k) const
  {
    const Level &level  = levels[l];
    const Place  p      = place_of(k);
    const bool   on_rim = p.along == 1 || p.along == level.n_along - 2 || p.across == 1 ||
                        p.across == level.n_across - 2;
    return on_rim && p.along % 3 == 1 && p.across % 3 == 1 ? number_of(on_parent(p))
                                                           : none;
  }

  std::size_t
  FlowLattice::start_of(const std::size_t k, const std::uint8_t number) const
  {
    Place      end          = place_of(k);
    const bool is_on_parent = number >= into_window;
    if (is_on_parent)
      end = on_parent(end);
    const auto [da, db] = directions[is_on_parent ? number - into_window : number];
    return finest(number_of({end.level, end.along - da, end.across - db}));
  }

  std::size_t
  FlowLattice::on_grid(const std::size_t k) const
  {
    Place p = place_of(k);
    while (p.level > 0)
      p = on_parent(p);
    return number_of(p);
  }

  std::vector<std::size_t>
  FlowLattice::points_around(const std::size_t k, const int reach) const
  {
    const Place              centre = place_of(k);
    std::vector<std::size_t> points;
    const int                reach_across = std::min(reach, n_across());
    for (int a = std::max(centre.along - reach, 0);
         a <= std::min(centre.along + reach, width() - 1);
         ++a)
      for (int b = centre.across - reach_across; b <= centre.across + reach_across; ++b)
        if (is_periodic() || (b >= 0 && b < n_across()))
          points.push_back(index(a, b));
    if (!is_covered.empty())
      for (std::size_t i = 0; i < points.size(); ++i)
        if (is_covered[points[i]])
          {
            const Place middle = place_of(finer(points[i]));
            for (const int b : {-1, 0, 1})
              for (const int a : {-1, 0, 1})
                points.push_back(
                  number_of({middle.level, middle.along + a, middle.across + b}));
          }
    return points;
  }

  std::vector<std::size_t>
  FlowLattice::inlet_points() const
  {
    std::vector<std::size_t> points;
    if (region == nullptr)
      {
        for (int b = 0; b < n_across(); ++b)
          points.push_back(finest(index(0, b)));
        for (std::size_t l = 1; l < levels.size(); ++l)
          for (int b = 1; levels[l].begins_at_inlet && b < levels[l].n_across - 1; ++b)
            if (const std::size_t k = number_of({static_cast<int>(l), 1, b});
                !is_covered[k])
              points.push_back(k);
      }
    else
      for (std::size_t k = 0; k < size(); ++k)
        if (region->is_inlet(k))
          points.push_back(k);
    return points;
  }

  GridPoint
  FlowLattice::point(const std::size_t k) const
  {
    const Place  p     = place_of(k);
    const Level &level = levels[p.level];
    const int    along = level.first + p.along;
    return along_x ? GridPoint{along, p.across, level.window}
                   : GridPoint{p.across, along, level.window};
  }

  std::size_t
  FlowLattice::index_of(const GridPoint &p) const
  {
    const int along = along_x ? p.ix : p.iy, across = along_x ? p.iy : p.ix;
    const int level = level_with(p.window, along, false);
    return finest(number_of({level, along - levels[level].first, across}));
  }

  bool
  FlowLattice::can_go_around(const std::size_t k,
                             const int         d_along,
                             const int         d_across,
                             const bool        first_along) const
  {
    const int         da = first_along ? d_along : 0, db = first_along ? 0 : d_across;
    const std::size_t corner = index(along(k) + da, across_of(k) + db);
    return region->is_joined(k, da, db) &&
           region->is_joined(corner, d_along - da, d_across - db);
  }

  bool
  FlowLattice::can_step_in_region(const std::size_t k,
                                  const int         d_along,
                                  const int         d_across) const
  {
    if (d_along == 0 || d_across == 0)
      return region->is_joined(k, d_along, d_across);
    return can_go_around(k, d_along, d_across, true) ||
           can_go_around(k, d_along, d_across, false);
  }
} // namespace strait
