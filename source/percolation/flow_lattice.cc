// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_lattice.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  FlowLattice::FlowLattice(const SlabField &field, const FlowDomain &domain)
    : layout(field.layout_pointer())
    , region(domain.region)
    , along_x(region != nullptr || domain.direction == FlowDirection::x)
    , lines(layout, domain)
    , values(lines.values(field))
  {
    const PeriodicGrid  &grid = field.grid();
    const double         dx = grid.dx(), dy = grid.dy();
    const std::ptrdiff_t line = lines.length();
    levels.push_back({0,
                      (along_x ? grid.nx : grid.ny) + 1,
                      (along_x ? grid.ny : grid.nx) + (region != nullptr ? 1 : 0),
                      {{along_x ? dx : dy, along_x ? dy : dx, std::hypot(dx, dy)}},
                      along_x ? 1 : line,
                      along_x ? line : 1,
                      -1,
                      0,
                      0});
    const int n_windows = static_cast<int>(layout->windows().size());
    for (int w = 0; w < n_windows; ++w)
      add_window(field, w);
  }

  bool
  FlowLattice::is_outlet(const std::size_t k) const
  {
    if (region != nullptr)
      return region->is_outlet(k);
    const Place  p     = place_of(k);
    const Level &level = levels[p.level];
    return p.level == 0 ? p.along == level.n_along - 1
                        : level.ends_at_outlet && p.along == level.n_along - 2;
  }

  void
  FlowLattice::add_window(const SlabField &field, const int w)
  {
    const ZoomWindow &window = layout->windows()[w];
    const int         last   = (along_x ? window.n_columns() : window.n_rows()) - 1;
    const int         seam   = layout->seam(w, along_x ? 0 : 1);
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
    const ZoomWindow &window   = layout->windows()[w];
    const double      fraction = std::pow(3., -window.level);
    // The first of the parent's columns that this part covers; on the grid, of those that
    // begin at the inlet and end with its copy at the outlet.
    int along = (along_x ? window.x : window.y) + part.first / 3;
    if (window.parent < 0)
      {
        const int period = levels.front().n_along - 1;
        along            = (along % period + period) % period;
        if (along == 0 && part.ends_at_outlet)
          along = period;
      }
    Level level           = levels.front();
    level.begin           = values.size();
    level.n_along         = part.last - part.first + 1;
    level.n_across        = along_x ? window.n_rows() : window.n_columns();
    level.along_by        = 1;
    level.across_by       = level.n_along;
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

    const std::size_t begin = layout->start_of_window(w);
    for (int b = 0; b < level.n_across; ++b)
      for (int a = part.first; a <= part.last; ++a)
        {
          const std::size_t ix = along_x ? a : b, iy = along_x ? b : a;
          values.push_back(field[begin + iy * window.n_columns() + ix]);
        }
    is_covered.resize(values.size(), false);
    const int own = static_cast<int>(levels.size()) - 1;
    for (int b = 1; b < level.n_across; b += 3)
      for (int a = 1; a < level.n_along; a += 3)
        for_each_copy(parent_of({own, a, b}),
                      [this](const std::size_t k) { is_covered[k] = true; });
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

  std::size_t
  FlowLattice::number_of(const Place &p) const
  {
    std::size_t number = none;
    for_each_copy(p, [&](const std::size_t k) { number = number == none ? k : number; });
    return number;
  }

  std::size_t
  FlowLattice::number_of_copy(const Place &p, const int periods) const
  {
    const Level &level = levels[p.level];
    if (p.level > 0)
      return periods != 0
               ? none
               : level.begin + static_cast<std::size_t>(p.across) * level.n_along +
                   p.along;
    const int across = wrapped(p.across) + periods * level.n_across;
    return along_x ? lines.number_of(across, p.along) : lines.number_of(p.along, across);
  }

  std::size_t
  FlowLattice::global_number(const Place &p) const
  {
    const Level &grid = levels.front();
    const auto   n    = static_cast<std::size_t>(grid.n_along);
    return p.level == 0 ? wrapped(p.across) * n + p.along
                        : grid.n_across * n + (number_of(p) - lines.size());
  }

  std::size_t
  FlowLattice::own_number(const std::size_t global) const
  {
    const Level &grid = levels.front();
    const auto   n    = static_cast<std::size_t>(grid.n_along);
    if (global >= grid.n_across * n)
      return layout->rank() == 0 ? global - grid.n_across * n + lines.size() : none;
    const std::size_t k =
      number_of({0, static_cast<int>(global % n), static_cast<int>(global / n)});
    return k != none && is_own(k) ? k : none;
  }

  FlowLattice::Place
  FlowLattice::parent_of(const Place &p) const
  {
    const Level &level = levels[p.level];
    return {level.parent, level.along + p.along / 3, level.across + p.across / 3};
  }

  FlowLattice::Place
  FlowLattice::finer(const Place &p) const
  {
    for (std::size_t l = 1; l < levels.size(); ++l)
      {
        const Level &level = levels[l];
        if (level.parent != p.level)
          continue;
        const int a = p.along - level.along, from = p.across - level.across;
        const int b = p.level == 0 ? wrapped(from) : from;
        if (a >= 0 && 3 * a < level.n_along && b >= 0 && 3 * b < level.n_across)
          return {static_cast<int>(l), 3 * a + 1, 3 * b + 1};
      }
    return p;
  }

  FlowLattice::Place
  FlowLattice::finest(const Place &p) const
  {
    const Place next = finer(p);
    return next.level == p.level ? p : finest(next);
  }

  bool
  FlowLattice::is_on_rim(const Place &p) const
  {
    const Level &level  = levels[p.level];
    const bool   on_rim = p.along == 1 || p.along == level.n_along - 2 || p.across == 1 ||
                        p.across == level.n_across - 2;
    return on_rim && p.along % 3 == 1 && p.across % 3 == 1;
  }

  std::size_t
  FlowLattice::start_of(const std::size_t k, const std::uint8_t number) const
  {
    Place      end          = place_of(k);
    const bool is_on_parent = number >= into_window;
    if (is_on_parent)
      end = parent_of(end);
    const auto [da, db] = directions[is_on_parent ? number - into_window : number];
    return global_number(finest({end.level, end.along - da, end.across - db}));
  }

  GridPoint
  FlowLattice::on_grid(const GridPoint &p) const
  {
    if (p.window < 0)
      return p;
    const int along = along_x ? p.ix : p.iy, across = along_x ? p.iy : p.ix;
    const int level = level_with(p.window, along, false);
    Place     place = {level, along - levels[level].first, across};
    while (place.level > 0)
      place = parent_of(place);
    return point(place);
  }

  std::vector<std::size_t>
  FlowLattice::points_around(const GridPoint &p, const int reach) const
  {
    const int along = along_x ? p.ix : p.iy, across = along_x ? p.iy : p.ix;
    const int n_across     = levels.front().n_across,
              reach_across = std::min(reach, n_across);
    std::vector<std::size_t> points;
    std::vector<Place>       in_windows;
    const auto               add_fine = [&](const Place &coarse) {
      if (const Place fine = finer(coarse); fine.level != coarse.level)
        for (const int b : {-1, 0, 1})
          for (const int a : {-1, 0, 1})
            in_windows.push_back({fine.level, fine.along + a, fine.across + b});
    };
    for (int a = std::max(along - reach, 0);
         a <= std::min(along + reach, levels.front().n_along - 1);
         ++a)
      for (int b = across - reach_across; b <= across + reach_across; ++b)
        if (region == nullptr || (b >= 0 && b < n_across))
          {
            if (const std::size_t k = number_of({0, a, b}); k != none)
              points.push_back(k);
            add_fine({0, a, b});
          }
    for (std::size_t i = 0; i < in_windows.size(); ++i)
      {
        points.push_back(number_of(in_windows[i]));
        add_fine(in_windows[i]);
      }
    return points;
  }

  std::vector<std::size_t>
  FlowLattice::inlet_points() const
  {
    std::vector<std::size_t> points;
    const auto               add = [&](const std::size_t k) {
      if (is_covered.empty() || !is_covered[k])
        points.push_back(k);
    };
    if (region != nullptr)
      {
        for (std::size_t k = 0; k < lines.size(); ++k)
          if (region->is_inlet(k))
            add(k);
        return points;
      }
    const auto [first, end] = lines.own_points();
    for (std::size_t k = first; k < end; k += along_x ? lines.length() : 1)
      if (place_of(k).along == 0)
        add(k);
    for (std::size_t l = 1; layout->rank() == 0 && l < levels.size(); ++l)
      for (int b = 1; levels[l].begins_at_inlet && b < levels[l].n_across - 1; ++b)
        add(number_of({static_cast<int>(l), 1, b}));
    return points;
  }

  GridPoint
  FlowLattice::point(const std::size_t k) const
  {
    return point(place_of(k));
  }

  GridPoint
  FlowLattice::point(const Place &p) const
  {
    const Level &level  = levels[p.level];
    const int    along  = level.first + p.along;
    const int    across = p.level == 0 ? wrapped(p.across) : p.across;
    return along_x ? GridPoint{along, across, level.window}
                   : GridPoint{across, along, level.window};
  }

  bool
  FlowLattice::can_go_around(const std::size_t k,
                             const int         d_along,
                             const int         d_across,
                             const bool        first_along) const
  {
    const int         da = first_along ? d_along : 0, db = first_along ? 0 : d_across;
    const std::size_t corner = k + da + static_cast<std::ptrdiff_t>(db) * lines.length();
    return region->is_joined(k, da, db) &&
           region->is_joined(corner, d_along - da, d_across - db);
  }
} // namespace strait
